"""The search for the fastest pose gait, a nonlinear program for IPOPT."""
