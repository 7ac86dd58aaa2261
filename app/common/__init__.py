"""Small values that every folder of app may use: version, clocks, free names, JSON without infinities."""
