"""The studio: it creates and connects all services, and publishes changes to the pages."""
