"""Pictures to foot positions: blobs, tracking, checkerboards, and the processes that do it."""
