"""Videos and camera recordings: upload, tracking as a job, recording together with a run."""
