"""Tests of `solver_jobs/patterns`."""
