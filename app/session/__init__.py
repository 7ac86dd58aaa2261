"""The one state owner: its command queue, and the events that it publishes."""
