"""The published experiments beside ours: reference data, computed figures, their store and plots."""
