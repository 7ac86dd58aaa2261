"""Browser tests of `app/static/segments`."""
