"""Browser tests of `app/static/trials`."""
