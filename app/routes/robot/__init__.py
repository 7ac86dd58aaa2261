"""HTTP routes of the robot: actions, jog, motor test, faults of the emulator, and the archive of runs."""
