"""Physics benchmarks."""
