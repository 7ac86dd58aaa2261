"""The robot as the studio uses it: actions, operator lease, jog, and the record of each run."""
