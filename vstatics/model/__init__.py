"""The transmission."""
