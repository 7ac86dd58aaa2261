"""Reports on trials, each one printable HTML file."""
