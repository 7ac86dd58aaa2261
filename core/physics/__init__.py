"""Simulation problems with their parameters, and the figures and findings of a simulated motion."""
