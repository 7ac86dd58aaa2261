"""Tests of `app/gaits`."""
