"""Tests of `solver_jobs/live`."""
