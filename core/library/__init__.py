"""The gaits that come with the program, sequences of them, and new ones."""
