"""Bridge and emulator benchmarks."""
