"""Tests of `robot_description`."""
