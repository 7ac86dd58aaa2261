"""Everything on disk: gait files in the data folder, and all the rest in one SQLite file."""
