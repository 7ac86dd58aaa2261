"""Atlases: spaces of gaits from which thousands are drawn and evaluated, and their results."""
