"""What every part of app may use: the version, free names, JSON without infinities."""
