"""Pose gaits: walks as poses between which all motors move straight, made for the firmware's clock."""
