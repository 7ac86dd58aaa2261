"""Browser tests of `app/static/state`."""
