"""The gaits, patterns and sequences that come with the program, and new gaits."""
