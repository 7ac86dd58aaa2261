"""Tests of `app/runs`."""
