"""Segment tables."""
