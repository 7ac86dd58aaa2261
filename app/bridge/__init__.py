"""The host's end of the cable: transport, write gate, state machine."""
