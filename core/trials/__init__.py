"""What a real robot did: foot tracks, how far it went, and when each iteration ended."""
