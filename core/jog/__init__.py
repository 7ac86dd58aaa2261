"""Steps by hand."""
