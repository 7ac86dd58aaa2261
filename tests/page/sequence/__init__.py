r"""Browser tests of `app\/static\/sequence`."""
