"""Recorded trajectories and waypoint files as gaits."""
