"""Trajectories and contact timelines, and what follows from them, such as speeds and stability margins."""
