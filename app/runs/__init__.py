"""The archive of runs: reading them, their figures, and their files."""
