"""The notebooks of the documentation, run anew and kept with their outputs."""
