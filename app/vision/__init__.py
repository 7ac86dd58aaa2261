"""From pictures to foot positions: blobs, checkerboards, tracking, and the processes that do it."""
