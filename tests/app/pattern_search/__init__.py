"""Tests of `app/pattern_search`."""
