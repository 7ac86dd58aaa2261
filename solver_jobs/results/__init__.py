"""The result types that the optimisers return."""
