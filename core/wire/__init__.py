"""What is sent: waypoints, merging, the wire's messages and times."""
