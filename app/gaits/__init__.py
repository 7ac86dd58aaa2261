"""The open gaits: editing, saving, versions, approvals, and the plan of each."""
