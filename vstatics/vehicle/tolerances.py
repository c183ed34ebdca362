"""Tolerances of vehicle calculations."""

from __future__ import annotations

SAME_SPEED = 1e-12
"""Relative excess over the last speed of the engine that counts as rounding noise. [-]"""
SAME_ENGINE_TORQUE = 1e-9
"""Largest difference of engine torques that count as equal. [N*m]"""
NO_DRAG = 1e-9
"""Sum of torques on a link that counts as rounding noise, relative to the largest. [-]"""
SAME_TORQUE_CLASS = 1e-9
"""Relative difference up to which a torque is at the bound of a class, or at a threshold. [-]"""
SAME_POWER = 1e-9
"""Relative difference up to which the powers of two gears count as equal. [-]"""
NO_CYCLE_ENERGY = 1e-13
"""Energy of a cycle that counts as rounding noise, relative to the sum of magnitudes. [-]"""
NO_SPEED = 1e-12
"""Relative speed of a link that counts as rounding noise. [-]"""
LEAST_EXCESS = 1e-9
"""Relative increase of an engine torque that rounding leaves just below the least one. [-]"""
AT_REST = 1e-10
"""Speed relative to the largest, at which the losses at rest are calculated. [-]"""
