"""Tolerances of synthesis: for rounding errors, and for sufficient accuracy."""

from __future__ import annotations

# The following tolerances are used in `gears`.
NEAR_DIRECT = 1e-6
"""Largest deviation from 1 of a ratio that is tested for being a direct drive. [-]"""
KEPT_PART = 2.0**-12
"""Smallest relative magnitude of a difference that retains enough digits. [-]"""
DETERMINED = 1e-9
"""Largest relative singular value and deviation of a torque share from 1 that count as 0. [-]"""
NO_TORQUE = 1e-12
"""Largest torque that counts as 0, relative to the input torque. [-]"""
MET_RATIO = 1e-9
"""Largest relative difference between output torque and ratio of a valid result. [-]"""

# The following tolerances are used in `ratios`.
PART_FOR_ZERO_BOUND = 1e-3
"""Value that replaces a bound of 0, relative to the opposite bound. [-]"""
NARROWEST_RATIO = 1e-3
"""Smallest magnitude of a ratio whose bounds include 0, relative to the larger bound. [-]"""
TINY_RATIO = 1e-4
"""Largest ratio that is printed with a power of ten. [-]"""
NO_SQUARES = 1e-30
"""Sum of squares below which only rounding errors are left. [-]"""
LEAST_FIT_STEP = 1e-13
"""Step at or below which a fit ends; a fit also ends when the damping exceeds the inverse. [-]"""
EQUAL_SUM_OF_SQUARES = 1e-14
"""Relative growth of a sum of squares near the minimum with which a step is still accepted. [-]"""
LEAST_DAMPING = 1e-13
"""Smallest damping, which prevents singular equations of a step. [-]"""
LEAST_SCALE = 1e-300
"""Smallest scale of the equations of a step, which prevents a division by zero. [-]"""
MET_RATIOS = 1e-20
"""Sum of squares below which all ratios are met except for rounding errors. [-]"""
SAME_SOLUTION = 1e-5
"""Largest difference of the logarithms of ratios for which solutions count as equal. [-]"""
AT_BOUND = 1e-14
"""Largest relative distance of a ratio from a bound that counts as 0. [-]"""
DEPENDENT_RATIOS = 1e-9
"""Relative sensitivity of gear ratios to a direction of mechanism ratios below which the direction
is undetermined. [-]
"""

# The following tolerances are used in `teeth`.
MET_ERROR = 1e-9
"""Largest error of a target due to the ranges of tooth numbers that counts as 0. [-]"""
TOLD_ERROR = 1e-3
"""Smallest error due to the ranges of tooth numbers that is reported. [-]"""
NARROW_WINDOW = 1e-4
"""Width in ln(ratio) below which a part of a range is not divided further. [-]"""
FIRST_ERROR_LIMIT = 1e-5
"""First tried limit of errors minus the smallest possible error. [-]"""
ROUNDED_TEETH = 1e-6
"""Largest deviation of a calculated tooth number from an integer that counts as rounding. [-]"""
ROUNDED_ERROR = 1e-12
"""Largest error that counts as rounding, so that the search can end. [-]"""
LARGEST_ERROR_WEIGHT = 1e-3
"""Factor of the largest error, which is added to the smallest error to order regions. [-]"""

# The following tolerances are used in the search for whole gearboxes.
NO_LOAD = 1e-9
"""Largest torque on a shift element that counts as 0, relative to the input torque. [-]"""
SAME_FITTED_RATIO = 1e-6
"""Largest relative difference of gear ratios that count as equal after a fit. [-]"""
EQUAL_FIGURES = 1e-7
"""Largest relative difference of figures that count as equal after a fit. [-]"""
SECOND_MOTION = 1e-9
"""Largest singular value that counts as 0, which means that a second motion is possible. [-]"""
STILL_SPEED = 1e-9
"""Largest speed of a link that counts as 0, relative to the fastest link. [-]"""
SAME_BOX_RATIO = 1e-9
"""Largest relative difference of gear ratios at a point within the bounds that count as equal. [-]
"""
NO_BOX_SPEED = 1e-11
"""Largest speed that counts as 0, relative to the largest speed in a gear. [-]"""
SAME_BOX_SPEED = 1e-9
"""Largest difference of speeds that count as equal. Different speeds are rarely so near by chance.
[-]
"""
TARGET_MARGIN = 1e-9
"""Addition to tolerances of targets in the search, because of rounding errors. [-]"""
INDEPENDENT_RATIO = 1e-10
"""Largest change of a quotient over the range of a gear-set ratio that counts as 0. [-]"""
BEYOND_WIDTH = 1e-10
"""Largest excess of a gear ratio over the range, relative to the width of the range. [-]"""
LEAST_BOX_STEP = 1e-12
"""Smallest step of a logarithm in a fit. [-]"""
LEAST_GAIN = 1e-14
"""Smallest relative reduction of the sum of squares for which a fit continues. [-]"""
LEAST_SUM_OF_SQUARES = 1e-20
"""Sum of squares at which a fit ends. [-]"""
LEAST_DIAGONAL = 1e-12
"""Addition to the diagonal of the normal equations, for gear-set ratios that affect no gear. [-]"""
FIRST_DAMPING = 1e-3
"""Damping of the first step, small enough for a nearly undamped Gauss-Newton step. [-]"""
LEAST_BOX_DAMPING = 1e-12
"""Smallest damping of a fit. [-]"""
LEAST_STIFFNESS = 1e-9
"""Addition to the normal equations of planes in a cell, relative to the largest diagonal. [-]"""
PLANE_ROUNDING = 1e-9
"""Rounding error of distances from planes, relative to half the width of the cell. [-]"""

# The following tolerances are used for bounds and figures of gearboxes.
NO_FIGURE = 1e-9
"""Largest speed or torque that counts as 0, relative to the input. [-]"""
CELL_ROUNDING = 1e-12
"""Margin for rounding where a cell of basic ratios is cut, relative to its width. [-]"""
NARROWEST_RANGE = 1e-5
"""Smallest half-width of a range, also if both ends are equal. [-]"""
