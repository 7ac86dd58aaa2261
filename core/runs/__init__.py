"""Figures of a recorded run: measured strokes, iterations and poses out of the robot's lines."""
