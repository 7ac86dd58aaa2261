"""Pattern benchmarks."""
