"""The robot's end of the cable: the firmware in virtual time, its board and its faults."""
