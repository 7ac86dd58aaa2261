"""Routes of the footfall-pattern search."""
