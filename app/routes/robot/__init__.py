"""HTTP routes of the robot: actions, jog, faults of the emulator, and the archive of runs."""
