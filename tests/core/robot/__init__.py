"""Tests of `core/robot`."""
