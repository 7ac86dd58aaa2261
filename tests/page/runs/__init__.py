r"""Browser tests of `app\/static\/runs`."""
