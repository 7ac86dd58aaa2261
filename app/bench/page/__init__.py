"""Benchmarks of the page in a browser, and of video tracking."""
