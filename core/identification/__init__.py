"""Fitting physics parameters to trials of the real robot (system identification)."""
