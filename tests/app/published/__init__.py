"""Tests of `app/published`."""
