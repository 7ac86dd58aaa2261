"""The optimisation problem as a value, its first guess, and the independent checker."""
