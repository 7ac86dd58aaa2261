"""Trials: tracks out of videos, kept beside runs."""
