"""The search for footfall patterns by OR-Tools CP-SAT; everything here loads that solver."""
