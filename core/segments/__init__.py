"""Segment tables: their layout, their repair, and the way from a contact timeline to a table."""
