"""The list of jobs, and optimisations in it."""
