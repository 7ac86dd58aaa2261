"""Small values that every folder of app may use: the version, the clocks, free names, JSON without infinities."""
