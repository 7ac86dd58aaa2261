"""The robot's cable: transport, session, and an emulated robot for the other end."""
