"""Solver benchmarks."""
