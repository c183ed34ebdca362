"""Tolerances of the calculation: when a difference is zero, when rounding is too large.

Tolerances of the arithmetic are multiples of the unit in the last place. Tolerances of a gear are
relative to the compared numbers, so that they suit gear trains of any ratio.
"""

from __future__ import annotations

EPSILON = 2.0**-52
"""Unit in the last place of 1."""

# Arithmetic of linear systems. Plans (recorded calculations) are either of fixed sign, for variants
# with equal signs, or of any sign.
ZERO = EPSILON
"""Largest difference that counts as 0, relative to the size that bounds the rounding error.

Such a difference must also be below `TRACED_REAL`.
"""
TRACED_REAL = 2.0**-20
"""Largest difference that counts as 0, relative to the larger term."""
TRACED_SAME = 32 * EPSILON
"""Fixed sign: largest difference that counts as 0 in a variant, relative to the larger term."""
TRACED_DIFFERENCE = 1 / 64
"""Fixed sign: smallest difference for which a plan is valid, relative to the larger term.

For a small relative difference in the first variant, the limit is a sixteenth of this difference,
but at least 1.5 times `TRACED_REAL`.
"""
SIGNED_LEAST = 2.0**-16
"""Any sign: smallest difference for which a plan is valid, relative to the terms.

If terms cancel, the relative rounding error therefore grows at most by the inverse of this number.
"""
SIGNED_SAME = 2.0**-36
"""Any sign: relative difference above which two terms differ, whatever their rounding error."""
PIVOT = 0.1
"""Smallest pivot relative to the largest entry of the row, to limit the growth of rows."""
SIGNED_PIVOT = 1 / 256
"""Any sign: `PIVOT` in the first variant; less, because guards limit the cancellation of sums."""

# Speeds, torques and powers of a gear.
TIE = 1e-9
"""Relative difference up to which speeds, or torques on a link, count as equal."""
UNCERTAIN = 1e-6
"""Relative error of speeds or torques above which a message is given."""
NEAR_ONE = 1e-4
"""Difference of a basic ratio from 1 below which a gear train is nearly singular."""
CLOSED = 1e-9
"""Error of the power balance, relative to the input power, above which a plan is rejected."""
NO_POWER = 1e-12
"""Largest power that counts as rounding, relative to the largest power of the gear.

It is also the smallest reference value for relative errors of speeds and torques.
"""
CYCLE = 1e-9
"""Largest power of a cycle that counts as rounding, relative to the largest power of the gear."""
STANDS_STILL = 1e-13
"""Change of an efficiency per iteration below which the iteration has converged."""
SAME_SOLUTION = 1e-10
"""Difference up to which two efficiencies or two speed ratios count as equal."""
LEAST_BOX_WIDTH = 1e-7
"""Width below which boxes of efficiencies are not halved, and least distance of corners. [-]"""
SAME_CLUSTER = 1e-5
"""Difference up to which efficiencies count as equal if a search cannot separate them."""
SAME_FIXED_POINT = 1e-9
"""Difference up to which separate fixed points of a search count as equal."""
BALANCED = 1e-9
"""Largest error of a balanced battery's power, relative to the sum of all powers."""

# Geometry and ratios: ratios of gears, rays of a speed plan, tips of teeth.
SAME_RATIO = 1e-9
"""Relative difference below which ratios of gears, or rays of a speed plan, count as equal."""
TIP_CLEARANCE = 1e-9
"""Clearance below which toothed gears touch, in modules."""

# Arrays of variants, and the plans that calculate them.
LAST_BITS = 1e-12
"""Largest relative difference between results from different processors."""
LEAST_INPUT = 1e-20
"""Smallest magnitude of inputs for a plan of any sign, and inverse of the largest magnitude."""
DECIMAL_DIGITS = 120
"""Digits of decimals for variants for which floats are too inaccurate.

Results keep three quarters of these digits, so that a number halfway between two floats is exact.
"""
DECIMAL_LEAST = 16
"""Factor by which the smallest valid difference in a plan is larger with floats than with decimals.

With decimals a sum loses seven digits at most.
"""
DECIMAL_ZERO = 1e-32
"""Magnitude below which a result calculated with decimals counts as 0."""
SURE_BOUNDS = 1e-9
"""Relative margin by which bounds must differ to decide a comparison in spite of rounding."""
SURE_MAGNITUDES = 1 + 1e-9
"""Factor by which bounds of magnitudes must differ to decide a comparison."""

# Numbers that are printed, or compared with expected results.
ROUNDED_COEFFICIENT = 1e-13
"""Relative rounding error of spring coefficients, which are given as decimals or calculated."""
SAME_POWER = 1e-9
"""Relative difference up to which power and the product of speed and torque agree."""
VISIBLE_EXCESS = 1e-4
"""Smallest relative excess of a torque over a capacity that printed digits show."""
NO_SENSITIVITY = 1e-10
"""Magnitude below which a relative sensitivity is only the rounding of finite differences."""
ROUNDED_NUMBER = 1e-12
"""Magnitude below which a printed value counts as rounding."""
ROUNDED_PART = 1e-9
"""Value that counts as rounding when printed, relative to the largest value of a quantity."""
ROUNDED_DEVIATION = 1e-14
"""Relative standard deviation up to which numbers differ only by rounding."""
ATOL = 1e-12
"""Default absolute tolerance of a comparison of results."""
RTOL = 1e-9
"""Default relative tolerance of a comparison of results."""
SAME_FORMULA = 1e-6
"""Largest relative difference between the value of a ratio formula and the ratio of the gear."""
SAME_TRIAL = 1e-12
"""Relative distance below which trial numbers in a search are not separated further."""
SAME_PUMP_TORQUE = 1e-12
"""Largest difference of the torques on the pump of a converter that counts as equal.

The difference is relative to the torque on the pump or, if larger, the most that the pump can take.
"""
SETTLED_PUMP_TORQUE = 1e-14
"""Difference of torques on a pump at which a search ends, relative like `SAME_PUMP_TORQUE`."""
