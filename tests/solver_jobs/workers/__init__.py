"""Tests of `solver_jobs/workers`."""
