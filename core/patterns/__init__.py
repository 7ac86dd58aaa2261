"""Footfall patterns: the problem, its rules, and an independent checker of patterns."""
