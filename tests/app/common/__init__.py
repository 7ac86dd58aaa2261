"""Tests of `app/common`."""
