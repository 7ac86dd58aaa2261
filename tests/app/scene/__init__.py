"""Tests of `app/scene`."""
