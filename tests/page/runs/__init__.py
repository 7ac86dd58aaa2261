"""Browser tests of `app/static/runs`."""
