"""Tolerances of the calculation: when a difference is zero, when rounding is too large.

Tolerances of the arithmetic are in units of the last place. Tolerances of a gear are relative to
the compared numbers, so that a train of any ratios is judged by its own numbers.
"""

from __future__ import annotations

EPSILON = 2.0**-52
"""Unit in the last place of 1."""

# Arithmetic of linear systems: "fixed sign" and "any sign" are the kinds of recorded plans.
ZERO = EPSILON
"""Largest difference that counts as 0, relative to the size that bounds its rounding error.

Such a difference must also be below `TRACED_REAL`.
"""
TRACED_REAL = 2.0**-20
"""Largest difference that counts as 0, relative to the larger of its two terms."""
TRACED_SAME = 32 * EPSILON
"""Fixed sign: largest difference that counts as 0 in a variant, relative to the larger term."""
TRACED_DIFFERENCE = 1 / 64
"""Fixed sign: smallest difference for which a plan is valid, relative to the larger term.

If smaller, a sixteenth of the relative difference in the first variant is enough, but at least 1.5
times `TRACED_REAL`.
"""
SIGNED_LEAST = 2.0**-16
"""Any sign: smallest difference for which a plan is valid, relative to the terms.

So rounding grows at most by the inverse of this factor where terms cancel.
"""
SIGNED_SAME = 2.0**-36
"""Any sign: relative difference above which two terms count as different at any rounding error."""
PIVOT = 0.1
"""Smallest pivot relative to the largest entry of the row, so that rows cannot grow."""
SIGNED_PIVOT = 1 / 256
"""Any sign: smallest relative pivot of the first variant; other sums are guarded as well."""

# Speeds, torques and powers of a gear.
TIE = 1e-9
"""Relative difference below which speeds, or torques on a link, are equal."""
UNCERTAIN = 1e-6
"""Relative disagreement of speeds or torques from which a message is given."""
NEAR_ONE = 1e-4
"""Difference of a ratio from 1 below which a train is nearly singular."""
CLOSED = 1e-9
"""Error of a power balance, relative to the input power, above which a plan is not used."""
NO_POWER = 1e-12
"""Largest power, relative to the largest power of the gear, that counts as rounding.

Where digits are counted, the same limit applies to speeds and torques relative to the input.
"""
CYCLE = 1e-9
"""Largest power of a cycle, relative to the largest power of the gear, that counts as rounding."""
STANDS_STILL = 1e-13
"""Change of an efficiency per pass below which the iteration has converged."""
SAME_SOLUTION = 1e-10
"""Difference below which two efficiencies are equal; converged passes are closer."""
BALANCED = 1e-9
"""Largest error of a battery's power, relative to all powers, that counts as balanced."""

# Numbers that are compared with each other: ratios of gears, rays of a plan, tips of teeth.
SAME_RATIO = 1e-9
"""Relative difference below which numbers of gears, or rays of a plan, are equal."""
TIP_CLEARANCE = 1e-9
"""Largest clearance between toothed gears, in modules, that counts as rounding."""

# Arrays of variants, and the plans that calculate them.
LAST_BITS = 1e-12
"""Largest relative difference of results that can come from the processor alone."""
LEAST_INPUT = 1e-20
"""Smallest magnitude of inputs for a plan of any sign; the largest magnitude is the inverse."""
SURE_BOUNDS = 1e-9
"""Relative margin by which bounds must differ to settle a comparison, due to rounding."""
SURE_MAGNITUDES = 1 + 1e-9
"""Factor by which bounds of magnitudes must differ to settle a comparison."""

# Numbers that are printed, or compared with expected results.
ROUNDED_COEFFICIENT = 1e-13
"""Relative rounding error of the coefficients of a spring, which are typed or calculated."""
SAME_POWER = 1e-9
"""Relative difference up to which power and the product of speed and torque agree."""
VISIBLE_EXCESS = 1e-4
"""Least relative excess of a torque over a capacity that shows in the printed digits."""
NO_SENSITIVITY = 1e-10
"""Magnitude of a relative sensitivity below which it is only rounding of finite differences."""
ROUNDED_NUMBER = 1e-12
"""Magnitude below which a printed value counts as rounding."""
ROUNDED_PART = 1e-9
"""Part of the largest number of a kind below which a printed value is rounding."""
ROUNDED_DEVIATION = 1e-14
"""Relative standard deviation up to which only last digits of the numbers differ."""
ATOL = 1e-12
"""Default absolute tolerance of a comparison of results."""
RTOL = 1e-9
"""Default relative tolerance of a comparison of results."""
SAME_FORMULA = 1e-6
"""Relative difference up to which a formula reproduces the ratio of its gear."""
SAME_TRIAL = 1e-12
"""Relative distance of neighbouring trials of a search between which no edge is searched for."""
SAME_PUMP_TORQUE = 1e-12
"""Largest difference of the torques on the pump of a converter that counts as equal.

It is relative to the torque of the gear, and to the largest torque that the pump takes.
"""
SETTLED_PUMP_TORQUE = 1e-14
"""Difference of the torques on a pump at which a search ends, relative as `SAME_PUMP_TORQUE`."""
