"""Browser tests of `app/static/learning`."""
