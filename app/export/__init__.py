"""A gait and its plan in other people's forms: files to keep, print, share and read elsewhere."""
