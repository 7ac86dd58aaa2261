"""What a physics simulation is asked and what it answers; the engine itself lives with the solvers."""
