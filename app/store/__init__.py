"""What is kept: gait files in the data folder, everything else in one SQLite file."""
