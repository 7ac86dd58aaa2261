"""Tests of `core/physics`."""
