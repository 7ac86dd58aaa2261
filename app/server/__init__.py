"""The web application, put together from the routes, its process, and limits of connections and log."""
