"""Helpers of the tests of trials."""
