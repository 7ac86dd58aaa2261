"""From a gait document to its plan: trajectory, waypoints, and the verified result of a solver."""
