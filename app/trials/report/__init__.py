"""Trials as one printable HTML file."""
