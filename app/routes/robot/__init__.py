"""Routes of the robot: verbs, jog, faults of the emulated one, and the archive of runs."""
