"""Learning parameters of the physics from trials, and the named sets of them."""
