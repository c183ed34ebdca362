"""Tolerances of the calculation: when a difference is nothing, when rounding is too large.

Those of the arithmetic are in units of the last place; those of a gear are parts of what
they are compared with, so that a train of any ratios is measured by its own numbers.
"""

from __future__ import annotations

EPSILON = 2.0**-52
"""A unit in the last place of 1."""

# arithmetic of linear systems
ZERO = EPSILON
"""A difference is zero when it is at most this part of its size, which bounds its rounding, ..."""
TRACED_REAL = 2.0**-20
"""... and this part of the larger of its terms."""
TRACED_SAME = 32 * EPSILON
"""Traced: what is zero leaves at most this part of its larger term; so do all variants."""
TRACED_DIFFERENCE = 1 / 64
"""Traced: a difference is at least this part of its larger term for all variants, or a
sixteenth of the part that the first variant has, but more than `REAL`."""
SIGNED_LEAST = 2.0**-16
"""Signed: the same; so rounding grows by this factor at most where terms cancel."""
SIGNED_SAME = 2.0**-36
"""Signed: what leaves more than this part is not zero for certain, whatever its size."""
PIVOT = 0.1
"""A pivot is at least this part of the largest entry in its row: so rows can't grow."""
SIGNED_PIVOT = 1 / 256
"""Signed: the same, in the first variant; other sums are watched besides."""

# a gear
TIE = 1e-9
"""Speeds, or torques on a link, that differ by less than this part are the same."""
UNCERTAIN = 1e-6
"""Speeds and torques that disagree by this part are told of."""
NEAR_ONE = 1e-4
"""A ratio that differs from 1 by less makes a train that is nearly singular."""
CLOSED = 1e-9
"""Powers agree to this part of the input power, or rounding is too large for a plan."""
NO_POWER = 1e-12
"""Power below this part of the largest one of the gear is rounding; so is a speed or torque
below this part of the input's, where digits are counted."""
CYCLE = 1e-9
"""A cycle of power with less than this part of the largest power of the gear is rounding."""
STANDS_STILL = 1e-13
"""An efficiency that moves by no more from pass to pass stands still."""
SAME_SOLUTION = 1e-10
"""Efficiencies that differ by no more are one solution: passes that stand still are nearer."""
BALANCED = 1e-9
"""A battery that gets what it is to have to this part of all powers is balanced."""

# results side by side
SAME_RATIO = 1e-9
"""Numbers of gears, or rays of a plan, that differ by no more than this part are the same."""
TIP_CLEARANCE = 1e-9
"""Room between wheels, in modules, that is lost in rounding."""

# arrays of variants
LAST_BITS = 1e-12
"""Numbers that differ by this part may differ by the processor alone."""
LEAST_INPUT = 1e-20
"""A plan of any sign is for no smaller magnitudes, nor for larger ones than its inverse."""
SURE_BOUNDS = 1e-9
"""Bounds settle a comparison only beyond this part of them, their own rounding."""
SURE_MAGNITUDES = 1 + 1e-9
"""Bounds settle a comparison only beyond their own rounding."""

# printed and compared numbers
ROUNDED_COEFFICIENT = 1e-13
"""Relative rounding error of the coefficients of a spring, which are typed or calculated."""
SAME_POWER = 1e-9
"""Relative difference up to which power and the product of speed and torque agree."""
VISIBLE_EXCESS = 1e-4
"""Relative excess over a capacity from which it shows in the printed digits."""
NO_SENSITIVITY = 1e-10
"""Relative sensitivity below which a number is the rounding of differences."""
ROUNDED_NUMBER = 1e-12
"""Number below which a printed value is rounding."""
ROUNDED_PART = 1e-9
"""Part of the largest number of a kind below which a printed value is rounding."""
ROUNDED_DEVIATION = 1e-14
"""Standard deviation, as a part of the numbers, that is the rounding of their last digits."""
ATOL = 1e-12
"""Default absolute tolerance of a comparison of results."""
RTOL = 1e-9
"""Default relative tolerance of a comparison of results."""
SAME_FORMULA = 1e-6
"""Relative difference up to which a formula gives the ratio of its gear."""
