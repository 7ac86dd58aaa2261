"""The gait document as JSON: schema, reading, writing, and migrations of older versions."""
