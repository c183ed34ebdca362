"""Tolerances of synthesis: what is equal but for rounding, and what is near enough."""

from __future__ import annotations

# gears
NEAR_DIRECT = 1e-6
"""Only gears with ratios so near to 1 may be direct drives."""
KEPT_PART = 2.0**-12
"""A number that is less than this part of its size has lost too many digits."""
DETERMINED = 1e-9
"""Singular values and shares of a torque that differ less from 0, or 1, do so by rounding."""
NO_TORQUE = 1e-12
"""A torque over the input's that is 0 but for rounding. [-]"""
MET_RATIO = 1e-9
"""Torques by which that of the output misses the ratio by more have lost their digits."""

# ratios
PART_FOR_ZERO_BOUND = 1e-3
"""A bound of 0, which no ratio has, stands for this part of the other bound."""
NARROWEST_RATIO = 1e-3
"""Where bounds have 0 between them, a ratio is no smaller than this part of the larger one."""
TINY_RATIO = 1e-4
"""A smaller ratio is told with a power of ten."""
NO_SQUARES = 1e-30
"""Squares whose sum is below this are rounding."""
LEAST_FIT_STEP = 1e-13
"""A step is nothing below this, and no step helps where the damping is the inverse of it."""
EQUAL_SUM_OF_SQUARES = 1e-14
"""By this part a sum of squares may grow: so near to its minimum it says nothing more, but
steps still lead there."""
LEAST_DAMPING = 1e-13
"""So much damping there is at least, by which the equations of a step are never singular."""
LEAST_SCALE = 1e-300
"""Equations of a step that have no number are not divided by one."""
MET_RATIOS = 1e-20
"""Sums of squares below this are all the same: nothing is left but rounding."""
SAME_SOLUTION = 1e-5
"""Solutions whose ratios differ by less than this part are one."""
AT_BOUND = 1e-14
"""A ratio that differs from a bound by less than this part stands at it."""
DEPENDENT_RATIOS = 1e-9
"""Directions in which the ratios change by less than this part, of the most, are free."""

# teeth
MET_ERROR = 1e-9
"""Limits of teeth that miss a ratio by no more are not told of."""
TOLD_ERROR = 1e-3
"""Ranges of teeth that let no ratios come nearer to all wishes together are told of."""
NARROW_WINDOW = 1e-4
"""Parts of which no ratio lies farther apart, in logarithms, are narrow enough."""
FIRST_ERROR_LIMIT = 1e-5
"""Limits of errors begin so much above the least possible error."""
ROUNDED_TEETH = 1e-6
"""What rounding may take from a number of teeth."""
ROUNDED_ERROR = 1e-12
"""An error of no more is rounding: there is nothing better."""
LARGEST_ERROR_WEIGHT = 1e-3
"""By this part of its largest error a region comes later."""

# whole boxes
NO_LOAD = 1e-9
"""An element whose torque is less than this part of the input's carries none."""
SAME_FITTED_RATIO = 1e-6
"""Ratios of a gear that differ by less than this part are one: they are fitted."""
EQUAL_FIGURES = 1e-7
"""Figures that differ by less than this part, or as much, are equal: they follow from fits."""
SECOND_MOTION = 1e-9
"""Elements that leave more than one motion have a singular value below this."""
STILL_SPEED = 1e-9
"""A speed below this part of the largest is none."""
SAME_BOX_RATIO = 1e-9
"""Ratios that differ by less, at a point within, are one: no chance makes them so. [-]"""
NO_BOX_SPEED = 1e-11
"""What is smaller, in terms of the largest speed in a gear, is nothing. [-]"""
SAME_BOX_SPEED = 1e-9
"""The same speeds differ by less; of the gears of one scheme no two agree so well by chance. [-]"""
TARGET_MARGIN = 1e-9
"""Targets are looked for that much further than the tolerance. [-]"""
INDEPENDENT_RATIO = 1e-10
"""A quotient does not depend on a ratio if it is as equal at both its ends. [-]"""
BEYOND_WIDTH = 1e-10
"""Part of the width of a range by which a gear may be beyond it: that is found step by step. [-]"""
LEAST_BOX_STEP = 1e-12
"""Of a logarithm: a shorter step changes nothing. [-]"""
LEAST_GAIN = 1e-14
"""Part of the sum of squares: a step that gains less was the last one. [-]"""
LEAST_SUM_OF_SQUARES = 1e-20
"""A sum of squares that can't be less. [-]"""
LEAST_DIAGONAL = 1e-12
"""Added to the diagonal, for ratios that no gear depends on. [-]"""
FIRST_DAMPING = 1e-3
"""The first step of a fit is nearly that of linear equations."""
LEAST_BOX_DAMPING = 1e-12
"""So much damping there is at least."""
LEAST_STIFFNESS = 1e-9
"""Of the normal equations of planes in a cell, as a share of their largest diagonal: they may be
singular. [-]"""
PLANE_ROUNDING = 1e-9
"""By so much more the points that planes leave may lie apart, as a share of half the cell. [-]"""

# bounds and figures
NO_FIGURE = 1e-9
"""Speed or torque, as a part of that of the input, below which it is rounding. [-]"""
CELL_ROUNDING = 1e-12
"""Rounding of the share of a cell at which it is cut. [-]"""
NARROWEST_RANGE = 1e-5
"""Half the width of a range that has one value. [-]"""
