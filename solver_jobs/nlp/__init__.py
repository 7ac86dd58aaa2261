"""The exact tier: the whole motion as one nonlinear program, solved by IPOPT."""
