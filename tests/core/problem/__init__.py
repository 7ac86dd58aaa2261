"""Tests of `core/problem`."""
