"""Tests of `app/undo`."""
