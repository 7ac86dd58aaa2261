"""The studio: every service behind one command queue, and what it publishes to the pages."""
