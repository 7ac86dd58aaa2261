"""The document that a person edits."""
