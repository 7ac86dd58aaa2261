"""Browser tests of `app/static/check`."""
