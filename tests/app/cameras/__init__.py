"""Tests of `app/cameras`."""
