"""From a gait document to a checked plan: what is shown, judged and sent."""
