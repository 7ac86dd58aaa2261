"""Trials of the real robot: foot tracks, compared with the plan and the simulation."""
