"""A studio that is driven by HTTP and killed at random moments, and what has to be there afterwards."""
