"""Tolerances of equal lengths, numbers and costs in pictures, and limits of visible values."""

from __future__ import annotations

SAME_TICK = 1e-9
"""Relative rounding error of a number of a scale above which more decimals are written. [-]"""
NO_LOSS_SHARE = 1e-9
"""Share of the power below which a loss counts as rounding noise. [-]"""
EFFICIENCY_STEP = 0.001
"""Smallest step of efficiencies, which determines the decimals. [-]"""
LEAST_SHOWN_POWER = 0.0005
"""Smallest relative power that is not shown as 0.000. [-]"""
SAME_POWER = 1e-9
"""Relative difference up to which a port and its run have equal powers, written once. [-]"""
SAME_CROSSINGS = 1 - 1e-9
"""Ratio of costs below which an order of a column counts as better, since sums are rounded. [-]"""
STANDS_IN_ALL_MODES = 1e-9
"""Relative amplitude below which a link counts as at rest in a mode. [-]"""
NO_LEVER_TORQUE = 1e-12
"""Torque or speed, relative to the input, below which it counts as 0. [-]"""
SAME_LEVER_COST = 1e-9
"""Smallest improvement of the cost of an order of levers that counts."""
LEAST_POINT_DISTANCE = 1e-3
"""Smallest relative distance of two points from which the height of a lever is calculated. [-]"""
SAME_RUN_SPEED = 1e-6
"""Relative difference up to which speeds or torques in a run count as equal, or as 0. [-]"""
NO_RUN_TORQUE = 1e-9
"""Torque below which a curve counts as rounding noise, relative to the largest torque. [-]"""
SAME_CURVE = 1e-9
"""Relative difference of values up to which curves count as equal. [-]"""
SAME_FREQUENCY = 0.005
"""Relative difference up to which frequencies of several gears are drawn as one frequency. [-]"""
SAME_RADIUS = 1e-9
"""Difference of coefficients of a twist up to which links count as on a common axis. [-]"""
