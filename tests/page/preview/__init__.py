"""Browser tests of `app/static/preview`."""
