"""What would make a drawing walk, as a person sees it: found, planned, and tried in physics."""
