"""The web application, put together from the routes, its process, and the limits of its connections and log."""
