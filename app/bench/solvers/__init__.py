"""Benchmarks of kinematics and of the optimisers."""
