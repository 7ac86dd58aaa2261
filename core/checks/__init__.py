"""The rules that a plan must keep before it can be approved, and the verdict."""
