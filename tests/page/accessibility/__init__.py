"""Browser tests of the page by keyboard, by touch and by assistive tools."""
