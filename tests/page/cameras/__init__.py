"""Browser tests of `app/static/cameras`."""
