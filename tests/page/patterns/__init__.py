"""Browser tests of `app/static/patterns`."""
