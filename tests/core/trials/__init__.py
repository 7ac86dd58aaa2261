"""Tests of `core/trials`."""
