"""Camera geometry, and foot tracks over time."""
