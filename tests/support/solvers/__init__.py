"""Helpers of the tests of the solvers."""
