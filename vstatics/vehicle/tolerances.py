"""Tolerances of vehicle calculations."""

from __future__ import annotations

SAME_SPEED = 1e-12
"""Excess over the last engine speed that counts as rounding noise, relative to this speed. [-]"""
SAME_ENGINE_TORQUE = 1e-9
"""Largest difference between engine torques that count as equal. [N*m]"""
SAME_DRAG_TORQUE = 1e-10
"""Change of an input torque at which drag relative to it is final, relative to 1 + torque. [-]"""
NO_DRAG = 1e-9
"""Sum of torques on a link that counts as rounding noise, relative to the largest torque. [-]"""
SAME_TORQUE_CLASS = 1e-9
"""Relative difference up to which a torque counts as equal to a class bound or threshold. [-]"""
SAME_GEAR_POWER = 1e-7
"""Difference up to which powers of gears count as equal, relative to engine and wheel power. [-]

It exceeds the power of open clutches, which `LEAST_FORCE_EXCESS` leaves above 0.
"""
NO_CYCLE_ENERGY = 1e-13
"""Energy of a cycle that counts as rounding noise, relative to the sum of all magnitudes. [-]"""
NO_SPEED = 1e-12
"""Speed of a link that counts as rounding noise, relative to the largest speed. [-]"""
LEAST_EXCESS = 1e-9
"""Relative increase of an engine torque that rounding left below the least value. [-]"""
LEAST_FORCE_EXCESS = 4e-9
"""Increase of the least wheel force against rounding, relative to least and asked force. [-]"""
LEAST_OPENING = 1e-11
"""Torque or power of a shift element that counts as 0, relative to its initial value. [-]"""
APPROACHES = (1e-3, 1e-3, 1e-4, -1.0)
"""Distances of trial torques from the predicted torque at which a freewheel opens. [-]

They are relative to the distance of the latest torque with a solution. The last trial has a
negative distance: it is on the other side of the prediction.
"""
AT_REST = 1e-10
"""Engine speed for losses at rest, relative to the last engine speed. [-]"""
SMALLEST_NUMBER = 1e-15
"""Smallest number above 0 of a vehicle, in SI units, so that its powers differ from 0."""
LARGEST_NUMBER = 1e15
"""Largest number of a vehicle, in SI units, so that the results of a cycle are finite."""
LOSSLESS = 1e-9
"""Distance of the search from speed ratios at which a converter loses no power, relative. [-]"""
BELOW_LOCK = 1 - 1e-6
"""Speed ratio just below the ratio at which a freewheel locks a converter up. [-]"""
