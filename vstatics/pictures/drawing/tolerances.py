"""Tolerances of equal lengths, numbers and costs in pictures, and limits of visible values."""

from __future__ import annotations

SAME_TICK = 1e-9
"""Relative tolerance of the numbers of a scale, above which more decimals are written. [-]"""
NO_LOSS_SHARE = 1e-9
"""Share of the power below which a loss is rounding noise. [-]"""
EFFICIENCY_STEP = 0.001
"""Smallest step of efficiencies, which determines the decimals. [-]"""
LEAST_SHOWN_POWER = 0.0005
"""Smallest power that is not shown as 0.000. [-]"""
SAME_POWER = 1e-9
"""Relative difference of equal powers of a port and a run, which are written once. [-]"""
SAME_CROSSINGS = 1 - 1e-9
"""Factor by which the cost of a better order of a column must be lower, since sums are rounded.
[-]"""
STANDS_IN_ALL_MODES = 1e-9
"""Amplitude below which a link is at rest in a mode, relative to the largest. [-]"""
NO_LEVER_TORQUE = 1e-12
"""Torque below which a sum is zero. [-]"""
SAME_LEVER_COST = 1e-9
"""Smallest improvement of the cost of an order of levers, which is in tenths."""
LEAST_POINT_DISTANCE = 1e-3
"""Smallest distance of two points of a lever, relative to the length, to avoid division by 0.
[-]"""
SAME_RUN_SPEED = 1e-6
"""Relative tolerance of equal speeds and of zero torques in a run. [-]"""
NO_RUN_TORQUE = 1e-9
"""Torque below which a curve is rounding noise, relative to the largest of all. [-]"""
SAME_CURVE = 1e-9
"""Relative difference of the values of equal curves. [-]"""
SAME_FREQUENCY = 0.005
"""Relative difference of frequencies of gears that are drawn as a single frequency. [-]"""
SAME_RADIUS = 1e-9
"""Difference of coefficients of a twist that belong to a common axis. [-]"""
