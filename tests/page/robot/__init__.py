"""Browser tests of `app/static/robot`."""
