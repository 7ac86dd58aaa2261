"""Small values that every folder of app may use: the version, free names, JSON without infinities."""
