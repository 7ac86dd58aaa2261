"""Trajectories and what can be said of any of them."""
