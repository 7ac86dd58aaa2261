"""HTTP routes of trials, cameras, videos and learning."""
