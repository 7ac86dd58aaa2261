"""The results that the solvers hand out."""
