"""Browser tests of `app/static/stage`."""
