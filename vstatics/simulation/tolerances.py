"""Tolerances of a simulation, grouped by purpose; relative to the largest value if not stated."""

from __future__ import annotations

# a run
RTOL = 1e-8
"""Default tolerance of the integration; also bounds the error of the energy balance."""
LEAST_RTOL = 3e-14
"""Smallest tolerance that the integrator accepts; less would be rounding."""
CLOSED_ENERGY = 1e-8
"""Largest error of the energy balance of a valid run, relative to the largest energy."""
NO_ENERGY = 1e-12
"""Largest energy that counts as 0. [J]"""
PRINTED = 1e-9
"""Ratio to the largest number of the same kind below which a table shows 0."""
CLOSED_BALANCE = 5e-4
"""Magnitude of the energy balance below which 0 is shown, as its digits are uncertain. [J]"""

# numbers that are given
LARGEST_NUMBER = 1e15
"""Largest plausible number in SI units: a ship has 1e9 kg, and turns at most at 1e2 rad/s."""
LEAST_NUMBER = 1e-15
"""Smallest plausible number in SI units: the balance wheel of a watch has 1e-9 kg*m^2."""
UNLIKE_INERTIAS = 1e-12
"""Ratio to the largest inertia below which an inertia is rounding."""

# times
SAME_INSTANT = 1e-11
"""Largest distance of events that count as simultaneous, relative to the duration."""
SAME_TIME = 1e-12
"""Largest relative difference of times that count as equal."""
SAME_END = 1e-13
"""Largest relative difference between the ends of a stretch and a piece that count as equal."""
AHEAD = 1e-7
"""Look-ahead and interval of slopes, relative to a duration or a step."""
SIGHT = 1e-6
"""Look-ahead for quantities derived from speeds, whose rounding is larger."""
LONGEST_DURATION = 1e4
"""Largest duration used as a time scale: motion in a long run is as fast as in a short run. [s]"""
LEAST_DURATION = 1e-9
"""Smallest duration used as a time scale of slopes. [s]"""
NO_PROGRESS = 1e-5
"""Progress, relative to the duration, below which a run counts as caught in endless switching."""
AHEAD_OF_STOP = (0.0, 1e-9, 1e-6, 1e-3)
"""Parts of the duration after a stop at which a torque is checked for invalid numbers."""
BEYOND_ALL = 1e6
"""Ratio to all other torques above which a torque at a stop is the cause. [-]"""
ROOT_PART = 1e-14
"""Tolerance of a polynomial root, relative to the interval; rounding allows no less."""
ROOT_TIME = 1e-15
"""Tolerance of a root of the margin itself, relative to the time."""

# speeds, torques, margins
STANDING = 1e-9
"""Relative speed, torque or impulse up to which a value counts as 0."""
NO_MARGIN = 1e-10
"""Largest violation of a margin that is ignored, relative to the scale of the margin."""
LEAST_VALUE = 1e-30
"""Smallest scale of a control state for tolerances."""
SMALL_VALUE = 1e-3
"""Ratio to the largest value of a control state down to which the tolerance shrinks."""
BETWEEN_INSTANTS = 1e-9
"""Accuracy of states between instants of a step, relative to the largest value in the step."""
BETWEEN_EXACT = 1e-10
"""Accuracy of states between instants of a step in closed form, as `BETWEEN_INSTANTS`."""
EQUAL_SIDES = 1e-10
"""Largest relative difference of compared numbers that count as equal."""
SOON = 1e2
"""Least size of compared numbers, as a multiple of the change of their difference ahead.

Times are rounded, so a difference that changes fast is uncertain.
"""
MET = 1e-3
"""Fraction of the look-ahead within which numbers that meet count as equal now."""
SLIDING = 1e-3
"""Largest distance from a jump, relative to the compared numbers, of a motion that slides on it."""
NEAR_LIMIT = 1e-3
"""Fraction of the look-ahead within which a state counts as at its limit."""
EXACT_SIDES = 1e-13
"""Largest relative difference of compared numbers that can be rounding and decides no side."""
ROUNDED_INPUT = 1e-14
"""Rounding error of a quantity in a formula, relative to the largest value of its kind."""
ROUNDED_SUM = 1e-15
"""Rounding error of a sum, relative to the sizes of its terms."""
PASSED_LIMIT = 1e-10
"""Largest violation of a torque limit that is ignored, relative to the largest torque."""
FALLING_MARGIN = 1e-12
"""Relative decrease of a margin during the look-ahead above which the margin counts as falling."""
TIGHT_SLACK = 1e-6
"""Largest distance from the smallest slack, relative to the largest slack, that counts as 0."""
REGULAR_CORNER = 1e-9
"""Determinant below which torque limits are nearly parallel and have no common corner."""
NO_SPLIT = 1e-12
"""Residual of the least-squares problem below which no split lies within all limits."""
WITHIN_LIMITS = 1e-6
"""Largest violation of limits that a split can have, relative to the largest slack.

This is the accuracy of the least-squares solution.
"""
SHARED_TORQUE = 1e-6
"""Component of a torque in a redundant direction above which the torque is indeterminate."""
SAME_VALUES = 1e-9
"""Largest relative difference of the values at a repeated instant that is not a jump."""
MADE_CAPACITY = 1e-9
"""Relative distance by which a control can be below 0, or above the capacity in the case."""
MISSING_MASS = 1e-3
"""Fraction of the mass of a vehicle that can be missing in the inertia of its link."""
LEAST_PROBABILITY = 2.0**-53
"""Smallest probability for a normal distribution, which is infinite at 0."""

SAME_TORQUE = 1e-13
"""Largest relative difference between a torque and the torque at which its efficiency is read."""
LEAST_EFFICIENCY = 1e-6
"""Smallest efficiency in the search for a torque that agrees with its efficiency."""

# matrices
INDEPENDENT_MOTION = 1e-9
"""Ratio to the largest singular value above which a direction is independent."""
BEARING_MOTION = INDEPENDENT_MOTION * 1e-3
"""Threshold of independence for weighted torques, lowered by the range of the weights."""
ROUNDED_MOTION = 1e-12
"""Part of a motion below which a component is rounding."""
MOVING_LINK = 1e-9
"""Speed in a motion below which a link is at rest."""
DEPENDENT = 1e-12
"""Ratio of singular values that counts as rounding, in least squares."""
LIGHT_MOTION = 1e-13
"""Ratio to the largest inertia of a motion below which a motion has no inertia."""
RIGID_SQUARE = 1e-10
"""Ratio to the largest squared frequency below which a motion is rigid."""
LEAST_MASS = 1e-30
"""Substitute for a zero mass under a root. [kg*m^2]"""
NOT_ZERO = 1e-300
"""Substitute for a zero divisor."""

# curves over time
CHORD = 8e-4
"""Largest distance of a curve from chords between stored instants, relative to its range.

People see a distance of 1e-3.
"""
NO_RANGE = 1e-9
"""Largest range of a column that counts as constant, relative to the largest of its kind."""
EQUAL_EXTREMES = 1e-7
"""Largest relative difference of extremes that count as equal: the accuracy of polynomials."""

# slopes
CHANGE_STEP, LONGEST_CHANGE_STEP = 1e-6, 1e-5
"""Interval of differences along a motion, relative to the duration, and the largest interval in s.

With these intervals, rounding leaves nine digits of a jerk.
"""
NO_CHANGE = 1e-14
"""Ratio to the terms of a sum below which a change is rounding."""
DIFFERENCE_STEP = 1e-6
"""Step of difference quotients, relative to the largest speed."""
NEWTON_STEP = 1e-13
"""Relative step below which Newton's method has converged."""
LEAST_SENSE = 1e-6
"""Least sensitivity of a torque to its rate, relative to the largest slope."""
NO_SENSE = 1e-30
"""Sensitivity of a torque to its rate where all slopes are 0. [N*m*s/rad]"""
STRAIGHT_BALANCE = 1e-12
"""Largest component of a nonlinear torque along a motion that counts as zero."""

# stretches in closed form
SHORTEST_PART = 2.0**-14
"""Smallest factor by which a part is shortened for nonlinear torques."""
FITTING_TORQUE = 1e-12
"""Accuracy of polynomials of torques, relative to the largest torque."""

# the published method
PUBLISHED_RTOL = 1e-12
"""Smallest tolerance of the published method."""
NO_COEFFICIENT = 1e-9
"""Ratio to the largest coefficient of a motion below which a coefficient is 0."""

# iterations
LAST_BIT = 2e-16
"""Relative step of the last iteration of a speed."""
