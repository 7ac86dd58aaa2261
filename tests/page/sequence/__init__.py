"""Browser tests of `app/static/sequence`."""
