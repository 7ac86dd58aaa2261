"""Tests of `core/recorded`."""
