"""Browser tests of `app/static/published`."""
