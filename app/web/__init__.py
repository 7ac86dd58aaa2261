"""The HTTP layer below the routes: access rules, errors, limits, and the assembly of the page."""
