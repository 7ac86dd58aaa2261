"""Cameras of this computer: their processes, their setups."""
