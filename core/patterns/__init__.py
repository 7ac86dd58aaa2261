"""Footfall patterns: who stands when, as a problem, its rules, and an independent judge of answers."""
