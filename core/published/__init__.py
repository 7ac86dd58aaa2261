"""The published tables: printed figures with their source, and the gait of the library behind each row."""
