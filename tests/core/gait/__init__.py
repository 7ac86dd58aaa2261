"""Tests of `core/gait`."""
