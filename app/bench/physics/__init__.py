"""Benchmarks of simulation and of learning."""
