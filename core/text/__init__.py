"""Files of people as text: bytes to text, plain numbers, tables in any dialect, JSON and TOML."""
