"""The robot as the studio sees it: verbs, operator lease, jog, live recording of a run."""
