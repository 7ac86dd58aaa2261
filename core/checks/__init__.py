"""The verdict: one rule family a file."""
