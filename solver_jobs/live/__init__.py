"""The live tier: the motion as one convex programme, fast enough to run while a finger drags."""
