"""Physics simulations of plans: the jobs, the stored results, and their view."""
