"""The gait document as JSON: schema, reading and writing, migrations."""
