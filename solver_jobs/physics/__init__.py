"""The physics simulation; MuJoCo is imported here and nowhere else."""
