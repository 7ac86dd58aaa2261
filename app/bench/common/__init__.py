"""What all benchmarks use: measuring, published cases and figures, edited gaits."""
