"""Tests of `app.scripting`, through `footfall` as a script has it."""
