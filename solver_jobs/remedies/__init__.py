"""What would make a drawing walk: changes that are tried before they are offered."""
