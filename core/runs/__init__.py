"""What a run's bytes say."""
