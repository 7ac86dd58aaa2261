"""Tests of `app/bench`."""
