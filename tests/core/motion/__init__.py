"""Tests of `core/motion`."""
