"""Requests that are made to break a running studio."""
