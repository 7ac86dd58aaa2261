"""Trials of the real robot: foot tracks out of videos, kept beside runs and gaits."""
