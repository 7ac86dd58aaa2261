"""HTTP routes and web sockets that belong to no group: events, jobs, robots and the 3D scene."""
