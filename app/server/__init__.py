"""The web application, put together from the routes, and its process."""
