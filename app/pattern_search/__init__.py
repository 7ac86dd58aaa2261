"""Searches for footfall patterns, one at a time for each page."""
