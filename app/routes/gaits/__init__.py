"""HTTP routes of gaits: documents, versions, approvals, exports, sequences and simulations."""
