"""Learning physics parameters from trials, and the named sets of them."""
