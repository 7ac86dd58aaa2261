"""Browser benchmarks."""
