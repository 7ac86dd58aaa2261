"""Physics parameters from trials (system identification)."""
