"""Browser tests of `app/static/optimise`."""
