"""The HTTP layer below the routes: access rules, errors, body limit, and the assembly of the page."""
