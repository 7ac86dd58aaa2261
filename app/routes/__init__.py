"""The web edge: HTTP and web sockets over the studio."""
