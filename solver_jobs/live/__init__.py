"""The live tier: the motion as one convex program, fast enough to solve during a drag."""
