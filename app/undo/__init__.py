"""A document's history: its log, who may undo what, three-way merge."""
