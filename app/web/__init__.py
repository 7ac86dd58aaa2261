"""The HTTP edge without routes: access rules, errors, body limit, page assembly, Viser proxy."""
