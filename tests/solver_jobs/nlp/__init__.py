"""Tests of `solver_jobs/nlp`."""
