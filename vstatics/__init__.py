"""Vehicle transmissions calculated from their kinematic scheme."""

__version__ = "0.1.0"
