"""Waypoints, how they are merged, and the messages and times of the robot's protocol."""
