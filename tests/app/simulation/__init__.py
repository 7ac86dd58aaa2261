"""Tests of `app/simulation`."""
