"""Benchmarks of the bridge and the emulator."""
