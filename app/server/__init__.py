"""The web application assembled, and its process."""
