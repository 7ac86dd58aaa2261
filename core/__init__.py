"""Pure mathematics and values with numpy alone; its own files: arrays, errors, findings, names, overrides."""
