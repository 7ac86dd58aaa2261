"""Browser tests of `app/static/document`."""
