"""Moving one motor, one foot or the body by hand, with a check of each step."""
