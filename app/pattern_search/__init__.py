"""Searches for footfall patterns, one a page."""
