"""Tests of `solver_jobs/tiers`."""
