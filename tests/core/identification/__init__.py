"""Tests of `core/identification`."""
