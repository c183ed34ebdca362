"""Pictures of a transmission and of its results."""
