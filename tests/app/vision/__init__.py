"""Tests of `app/vision`."""
