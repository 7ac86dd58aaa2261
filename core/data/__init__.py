"""Gaits and segment definitions that come with the program, as data."""
