"""Tests of `app/store`."""
