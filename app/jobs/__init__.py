"""The list of jobs, and optimisations as jobs."""
