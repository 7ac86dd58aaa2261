"""Worker processes, the services that talk to them, and the queue of jobs."""
