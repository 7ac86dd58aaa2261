"""Tests of `app/robot`."""
