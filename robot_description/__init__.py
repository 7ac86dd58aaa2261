"""One parameters file for each robot, and the builder that makes URDF and meshes from it."""
