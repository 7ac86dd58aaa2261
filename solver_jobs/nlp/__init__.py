"""The exact tier: one nonlinear programme, IPOPT."""
