"""The tables that come with the program, such as gaits, segments and physics parameters, and their loader."""
