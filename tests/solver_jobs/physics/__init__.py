"""Tests of `solver_jobs/physics`."""
