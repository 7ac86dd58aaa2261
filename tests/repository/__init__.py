"""Tests of the repository itself: structure, packaging, README, documentation."""
