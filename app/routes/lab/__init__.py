"""Routes of the laboratory: trials, cameras, videos and learning from trials."""
