"""The optimisation problem as a value, its initial guess, and the independent checker of its solutions."""
