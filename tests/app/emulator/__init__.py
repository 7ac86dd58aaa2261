"""Tests of `app/emulator`."""
