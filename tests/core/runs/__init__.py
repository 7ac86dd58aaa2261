"""Tests of `core/runs`."""
