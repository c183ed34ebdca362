"""Tolerances of synthesis, for rounding errors and for sufficient accuracy."""

from __future__ import annotations

# gears
NEAR_DIRECT = 1e-6
"""Largest deviation from 1 of the ratio of a possible direct drive. [-]"""
KEPT_PART = 2.0**-12
"""Least relative size of a difference that retains enough digits. [-]"""
DETERMINED = 1e-9
"""Largest relative singular value, and deviation of a torque share from 1, that count as 0. [-]"""
NO_TORQUE = 1e-12
"""Largest torque per input torque that counts as 0. [-]"""
MET_RATIO = 1e-9
"""Largest deviation of the output torque from the ratio without a loss of digits. [-]"""

# ratios
PART_FOR_ZERO_BOUND = 1e-3
"""Replacement of a bound of 0, as a share of the opposite bound. [-]"""
NARROWEST_RATIO = 1e-3
"""Least magnitude of a ratio whose bounds have opposite signs, as a share of the larger. [-]"""
TINY_RATIO = 1e-4
"""Largest ratio that is printed with a power of ten. [-]"""
NO_SQUARES = 1e-30
"""Sum of squares below which only rounding is left. [-]"""
LEAST_FIT_STEP = 1e-13
"""Least step of a fit; the inverse is the damping at which no step helps. [-]"""
EQUAL_SUM_OF_SQUARES = 1e-14
"""Allowed relative growth of a sum of squares near the minimum, where steps still converge. [-]"""
LEAST_DAMPING = 1e-13
"""Least damping, which prevents singular equations of a step. [-]"""
LEAST_SCALE = 1e-300
"""Least scale of the equations of a step, to avoid a division by zero. [-]"""
MET_RATIOS = 1e-20
"""Sum of squares below which all ratios are met except for rounding. [-]"""
SAME_SOLUTION = 1e-5
"""Largest relative difference of ratios with which solutions count as equal. [-]"""
AT_BOUND = 1e-14
"""Largest relative distance of a ratio from a bound that counts as 0. [-]"""
DEPENDENT_RATIOS = 1e-9
"""Relative change of the ratios in a direction, below which the direction is free. [-]"""

# teeth
MET_ERROR = 1e-9
"""Largest error of a target, due to the ranges of teeth alone, that counts as 0. [-]"""
TOLD_ERROR = 1e-3
"""Least error of the ratios caused by ranges of teeth that is reported. [-]"""
NARROW_WINDOW = 1e-4
"""Width of a part, in ln(ratio), at which the part is not divided further. [-]"""
FIRST_ERROR_LIMIT = 1e-5
"""Difference of the first tried limit of errors and the least possible error. [-]"""
ROUNDED_TEETH = 1e-6
"""Largest deviation of a calculated tooth number that counts as rounding. [-]"""
ROUNDED_ERROR = 1e-12
"""Largest error that counts as rounding, so that the search can end. [-]"""
LARGEST_ERROR_WEIGHT = 1e-3
"""Share of the largest error of a region in the order of the search. [-]"""

# whole boxes
NO_LOAD = 1e-9
"""Largest torque on a shift element, per input torque, that counts as 0. [-]"""
SAME_FITTED_RATIO = 1e-6
"""Largest relative difference of gear ratios that count as equal after a fit. [-]"""
EQUAL_FIGURES = 1e-7
"""Largest relative difference of figures that count as equal after a fit. [-]"""
SECOND_MOTION = 1e-9
"""Largest singular value that counts as 0, so that a second motion is possible. [-]"""
STILL_SPEED = 1e-9
"""Largest speed of a link, relative to the fastest link, that counts as 0. [-]"""
SAME_BOX_RATIO = 1e-9
"""Largest relative difference of ratios at a point within the bounds that count as equal. [-]"""
NO_BOX_SPEED = 1e-11
"""Largest speed that counts as 0, relative to the largest in a gear. [-]"""
SAME_BOX_SPEED = 1e-9
"""Largest difference of speeds that count as equal; they rarely agree by chance. [-]"""
TARGET_MARGIN = 1e-9
"""Additional tolerance for the search of targets. [-]"""
INDEPENDENT_RATIO = 1e-10
"""Largest change of a quotient over the range of a gear-set ratio that counts as 0. [-]"""
BEYOND_WIDTH = 1e-10
"""Share of the width of a range by which a gear can exceed the range. [-]"""
LEAST_BOX_STEP = 1e-12
"""Least step of a logarithm. [-]"""
LEAST_GAIN = 1e-14
"""Least relative reduction of the sum of squares in a further step. [-]"""
LEAST_SUM_OF_SQUARES = 1e-20
"""Sum of squares at which a fit ends. [-]"""
LEAST_DIAGONAL = 1e-12
"""Addition to the diagonal, for ratios without influence on any gear. [-]"""
FIRST_DAMPING = 1e-3
"""Damping of the first step, so small that it is nearly an undamped Gauss-Newton step. [-]"""
LEAST_BOX_DAMPING = 1e-12
"""Least damping of a fit. [-]"""
LEAST_STIFFNESS = 1e-9
"""Addition to the normal equations of planes in a cell, relative to the largest diagonal. [-]"""
PLANE_ROUNDING = 1e-9
"""Rounding of the points between planes, relative to half the cell. [-]"""

# bounds and figures
NO_FIGURE = 1e-9
"""Largest speed or torque, relative to the input, that counts as 0. [-]"""
CELL_ROUNDING = 1e-12
"""Rounding of the share at which a cell is cut. [-]"""
NARROWEST_RANGE = 1e-5
"""Smallest half-width of a range, also if both ends are equal. [-]"""
