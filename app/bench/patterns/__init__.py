"""Benchmarks of the search for footfall patterns."""
