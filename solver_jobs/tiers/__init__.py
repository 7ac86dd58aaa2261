"""Answers that need both tiers."""
