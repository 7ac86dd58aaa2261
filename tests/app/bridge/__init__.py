"""Tests of `app/bridge`."""
