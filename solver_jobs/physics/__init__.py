"""The physics engine's side: MuJoCo is imported in this folder and nowhere else."""
