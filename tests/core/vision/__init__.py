"""Tests of `core/vision`."""
