"""Small values for every folder of app: the version, the clocks, free names, JSON without infinities."""
