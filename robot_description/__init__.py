"""What the robot is: parameters, and the builder that makes meshes and URDF from them."""
