"""Tests of `core/published`."""
