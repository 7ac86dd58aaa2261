"""Camera geometry and tracks."""
