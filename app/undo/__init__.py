"""The undo history of a document: its steps, whose they are, and the three-way merge."""
