"""Runs that were kept: what they were to do, what they did, and their files."""
