"""The host's end of the cable: transport, write gate, robot state machine, rules of the operator lease."""
