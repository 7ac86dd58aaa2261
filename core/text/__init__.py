"""Text of people: from bytes, plain numbers, tables in any dialect, JSON, TOML, and as terminals show it."""
