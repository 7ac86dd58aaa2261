"""Learning from trials: gaits out of trials and tables, jobs, sets."""
