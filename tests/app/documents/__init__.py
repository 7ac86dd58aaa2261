"""Tests of `app/documents`."""
