"""Browser tests of whole journeys."""
