"""Tests of `app/atlas`."""
