"""Tests of `app/studio`."""
