"""Tests of `core/library`."""
