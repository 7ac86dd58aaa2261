"""Thousands of gaits for the robot's clock at once: each by a few convex steps, over arrays of gaits."""
