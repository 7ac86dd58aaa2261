"""What is computed: optimisation problems, solvers and the worker processes that run them."""
