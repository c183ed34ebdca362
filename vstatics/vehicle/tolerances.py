"""Tolerances of a vehicle: when two numbers are equal, and when one is rounding."""

from __future__ import annotations

SAME_SPEED = 1e-12
"""Relative excess over the last speed of the engine up to which a speed is that speed."""
SAME_ENGINE_TORQUE = 1e-9
"""Difference up to which torques of the engine are equal. [N*m]"""
NO_DRAG = 1e-9
"""Sum of torques on a link, as a part of the largest, that is rounding."""
