"""Atlases: thousands of evaluated gaits in one file, made on this machine or on many, and used."""
