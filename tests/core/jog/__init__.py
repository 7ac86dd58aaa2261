"""Tests of `core/jog`."""
