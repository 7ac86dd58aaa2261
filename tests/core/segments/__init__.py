"""Tests of `core/segments`."""
