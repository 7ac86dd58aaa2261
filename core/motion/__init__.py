"""Trajectories, and what follows from any of them: timeline, balance, speeds, heading."""
