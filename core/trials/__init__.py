"""How far a real robot went, computed from its foot tracks."""
