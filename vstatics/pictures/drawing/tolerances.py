"""When lengths, numbers or costs of a picture are the same, and what is too small to be shown."""

from __future__ import annotations

SAME_TICK = 1e-9
"""Numbers of a scale, to this part of the largest: a decimal more would say nothing."""
NO_LOSS_SHARE = 1e-9
"""A smaller share of the power is rounding. [-]"""
EFFICIENCY_STEP = 0.001
"""Numbers of efficiencies have the decimals of this one. [-]"""
LEAST_SHOWN_POWER = 0.0005
"""What is less is not 0.000. [-]"""
SAME_POWER = 1e-9
"""Of a port and its run, as part of the larger one: a number is written once."""
SAME_CROSSINGS = 1 - 1e-9
"""An order of a column must cost less than this part of another: sums of powers are rounded."""
STANDS_IN_ALL_MODES = 1e-9
"""What moves less, where the largest amplitude is 1, is rounding."""
NO_LEVER_TORQUE = 1e-12
"""Torques that are sums may leave as much. [-]"""
SAME_LEVER_COST = 1e-9
"""An order of levers must cost less by this: spans are whole numbers and tenths."""
LEAST_POINT_DISTANCE = 1e-3
"""Of two points of a lever, as part of its length, where room between them is divided by it."""
SAME_RUN_SPEED = 1e-6
"""Speeds are the same, and a torque is none, to this part of the largest."""
NO_RUN_TORQUE = 1e-9
"""A torque that is always less, as part of the largest of all, is rounding."""
SAME_CURVE = 1e-9
"""Curves whose values differ by no more than this part of the largest are one."""
SAME_FREQUENCY = 0.005
"""Frequencies of gears that differ by less than this part are drawn as one."""
SAME_RADIUS = 1e-9
"""Difference of the coefficients of a twist that belong to one axis."""
