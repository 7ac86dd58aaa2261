"""Browser tests of `app/static/plots`."""
