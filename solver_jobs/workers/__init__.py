"""Processes: one kind of worker, one kind of service, the job queue."""
