"""Computations that use both tiers: starting the exact one from the live one, the frontier."""
