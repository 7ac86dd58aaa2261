"""Browser tests of `app/static/timeline`."""
