"""The one thread that owns the studio's state, its command queue, and the events for the pages."""
