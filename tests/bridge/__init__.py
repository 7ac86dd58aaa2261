"""Tests of the wire, the emulated robot and the bridge."""
