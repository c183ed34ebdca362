"""Tolerances for equal lengths, numbers and costs in pictures, and limits of visible values."""

from __future__ import annotations

SAME_TICK = 1e-9
"""Rounding error of the numbers of a scale above which a further decimal is written. [-]"""
NO_LOSS_SHARE = 1e-9
"""Share of the power below which a loss counts as rounding noise. [-]"""
EFFICIENCY_STEP = 0.001
"""Smallest step between numbers of an efficiency scale. [-]"""
LEAST_SHOWN_POWER = 0.0005
"""Smallest relative power that is not shown as 0.000. [-]"""
SAME_POWER = 1e-9
"""Relative difference up to which the power of a port equals the power of its run, so that it is
not written again. [-]
"""
SAME_CROSSINGS = 1 - 1e-9
"""Quotient of new and old cost of crossings below which a new order counts as better. [-]"""
STANDS_IN_ALL_MODES = 1e-9
"""Relative amplitude below which a link counts as at rest in a mode. [-]"""
NO_LEVER_TORQUE = 1e-12
"""Threshold of torque or speed, relative to the input; smaller values count as 0. [-]"""
SAME_LEVER_COST = 1e-9
"""Smallest improvement of the cost of an order of levers that counts."""
LEAST_POINT_DISTANCE = 1e-3
"""Distance of lever points, relative to the lever's length, below which its height is constant. [-]
"""
SAME_RUN_SPEED = 1e-6
"""Relative difference up to which speeds or torques of a run count as equal, or as 0. [-]"""
NO_RUN_TORQUE = 1e-9
"""Torque below which a curve counts as rounding noise, relative to the largest torque. [-]"""
SHORTEST_GEAR = 1e-9
"""Duration below which a gear counts as not engaged, relative to the run. [-]"""
SAME_CURVE = 1e-9
"""Relative difference of values up to which curves count as equal. [-]"""
SAME_FREQUENCY = 0.005
"""Relative difference up to which the frequencies of several gears are drawn as equal. [-]"""
SAME_RADIUS = 1e-9
"""Difference of two coefficients in the twist of a spring up to which the links share an axis. [-]
"""
