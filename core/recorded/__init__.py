"""From a recording to a gait."""
