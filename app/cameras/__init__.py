"""Cameras of this computer: their processes and their setups."""
