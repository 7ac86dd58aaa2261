"""HTTP routes of trials, cameras, videos, learning and published experiments."""
