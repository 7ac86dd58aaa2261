"""The commands of atlases: run, front, export and open."""
