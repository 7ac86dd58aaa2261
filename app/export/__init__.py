"""A gait or its plan in other file formats, and gaits from other programs' files."""
