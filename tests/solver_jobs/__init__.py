"""Tests of `solver_jobs`."""
