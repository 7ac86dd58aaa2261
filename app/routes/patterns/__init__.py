"""HTTP routes of the search for footfall patterns."""
