"""A complete data folder: made by the program itself, packed, and read by a later program."""
