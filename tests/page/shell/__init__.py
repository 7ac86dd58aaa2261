"""Browser tests of `app/static/shell`."""
