"""Tests of `core/wire`."""
