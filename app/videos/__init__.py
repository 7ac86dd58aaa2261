"""Videos and camera recordings: upload, tracking as a job, recording with a run."""
