"""The gait document that a person edits, and transitions between gaits."""
