"""Pure mathematics and values, with numpy alone; its own files are arrays, errors, findings, names and overrides."""
