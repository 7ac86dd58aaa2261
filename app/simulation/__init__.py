"""Physics of a plan as a job: what is asked, what is kept, what is shown."""
