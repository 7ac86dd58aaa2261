"""Tests of `app/videos`."""
