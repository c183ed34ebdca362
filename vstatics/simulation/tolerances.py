"""Tolerances of a simulation, grouped by purpose; relative to the largest value unless stated."""

from __future__ import annotations

# a run
RTOL = 1e-8
"""Default relative tolerance of a run."""
LEAST_RTOL = 3e-14
"""Smallest relative tolerance that the integrator accepts; less would be rounding error."""
CLOSED_ENERGY = 1e-8
"""Largest error of the energy balance of a valid run, relative to the largest energy."""
NO_ENERGY = 1e-12
"""Error of the energy balance that is always allowed. [J]"""
PRINTED = 1e-9
"""Number below which a table prints 0, relative to the largest number of the same kind."""
CLOSED_BALANCE = 5e-4
"""Energy balance below which 0 is printed, because its digits are uncertain. [J]"""

# input numbers
LARGEST_NUMBER = 1e15
"""Largest plausible input in SI units: for example, a ship has a mass of 1e9 kg."""
LEAST_NUMBER = 1e-15
"""Smallest plausible input in SI units: the balance wheel of a watch has 1e-9 kg*m^2."""
UNLIKE_INERTIAS = 1e-12
"""Inertia that counts as rounding error, relative to the largest inertia."""

# times
SAME_INSTANT = 1e-11
"""Largest time between events that count as simultaneous, relative to the duration."""
SAME_TIME = 1e-12
"""Largest relative difference of times that count as equal."""
SAME_END = 1e-13
"""Largest relative difference between the end of a stretch and a time that counts as equal."""
AHEAD = 1e-7
"""Time of a look-ahead, and interval of difference quotients, relative to a duration."""
SIGHT = 1e-6
"""`AHEAD` for quantities derived from speeds, whose rounding errors are larger."""
LONGEST_DURATION = 1e4
"""Largest duration used as a time scale, since motion in a long run is not slower. [s]"""
LEAST_DURATION = 1e-9
"""Smallest duration used as a time scale. [s]"""
NO_PROGRESS = 1e-5
"""Progress of time below which a run counts as endless switching, relative to the duration."""
AHEAD_OF_STOP = (0.0, 1e-9, 1e-6, 1e-3)
"""Times after a stop at which torques are checked for invalid numbers, relative to the duration."""
BEYOND_ALL = 1e6
"""Smallest torque reported as the cause of an aborted run, relative to its large torques. [-]"""
ROOT_PART = 1e-14
"""Tolerance of the root of a polynomial, relative to the interval."""
ROOT_TIME = 1e-15
"""Tolerance of the time at which a margin is 0, relative to the time."""
ALONG_TANGENT = 1e-7
"""Largest move to an event along the tangent of the motion, relative to the time step.

The error is the square of this ratio.
"""

# speeds, torques, margins
STANDING = 1e-9
"""Relative speed, torque or impulse that counts as 0."""
NO_MARGIN = 1e-10
"""Largest violation of a margin that is ignored, relative to the scale of the margin."""
LEAST_VALUE = 1e-30
"""Smallest scale of a control state for tolerances."""
SMALL_VALUE = 1e-3
"""Smallest scale of a control state in the tolerance, relative to the largest value."""
BETWEEN_INSTANTS = 1e-9
"""Error of states between instants of a time step, relative to the largest value in the step."""
BETWEEN_EXACT = 1e-10
"""`BETWEEN_INSTANTS` for a step in closed form."""
EQUAL_SIDES = 1e-10
"""Largest relative difference of compared numbers that count as equal."""
SOON = 1e2
"""Smallest scale of compared numbers, relative to the change of their difference in a look-ahead.

Times have rounding errors, so a difference that changes fast is uncertain.
"""
MET = 1e-3
"""Fraction of the look-ahead within which numbers that become equal count as equal now."""
FINE_SWING = 1e-7
"""Largest swing about a jump that counts as sliding at any frequency; relative like `SLIDING`."""
SLIDING = 1e-3
"""Largest distance of a sliding motion from the jump, relative to the compared numbers."""
NEAR_JUMP = 1e-9
"""Distance from a jump that counts as nearly 0, relative to the compared numbers."""
NO_STEP = 1e-6
"""Step of a torque or of a rate at a jump that counts as 0, relative to the largest values."""
ROUNDED_SHARE = 1e-13
"""Change of the share of a sliding motion that counts as rounding error."""
PROPORTIONAL = 1e-9
"""Relative difference up to which samples of two compared differences are proportional."""
STEP_PART = 0.01
"""Tolerance of a time step, relative to the tolerance of the run."""
STEP_PART_AT_CORNERS = 0.001
"""`STEP_PART` for interpolated losses, which have corners within time steps."""
NEAR_LIMIT = 1e-3
"""Fraction of the look-ahead within which a state that reaches a limit counts as at the limit."""
EXACT_SIDES = 1e-13
"""Largest relative difference of compared numbers that can be rounding error."""
ROUNDED_INPUT = 1e-14
"""Rounding error of a quantity in a formula, relative to the largest value of the same kind."""
ROUNDED_SUM = 1e-15
"""Rounding error of a sum, relative to the magnitudes of its terms."""
PASSED_LIMIT = 1e-10
"""Largest violation of a torque limit that is ignored, relative to the largest torque."""
FALLING_MARGIN = 1e-12
"""Relative decrease during the look-ahead above which a margin counts as falling."""
TIGHT_SLACK = 1e-6
"""Largest difference from the smallest slack that counts as 0, relative to the largest slack."""
REGULAR_CORNER = 1e-9
"""Determinant below which torque limits are nearly parallel and have no intersection."""
SAME_ROOM = 1e-12
"""Difference between smallest slacks that is rounding, relative to the largest slack."""
NO_SPLIT = 1e-12
"""Residual of the least-squares problem below which no split is within all limits."""
WITHIN_LIMITS = 1e-6
"""Largest violation of limits by a split, relative to the largest slack.

This is the accuracy of the least-squares solution.
"""
SHARED_TORQUE = 1e-6
"""Share of a torque in a redundant direction above which this torque is indeterminate."""
SAME_VALUES = 1e-9
"""Largest relative difference between values at a repeated instant without a jump."""
MADE_CAPACITY = 1e-9
"""Relative excess of a control over its range that is ignored."""
MISSING_MASS = 1e-3
"""Fraction of a vehicle's mass that can be missing in the inertia of its link."""
WHOLE_TURNS = 1e-2
"""Largest difference from whole turns at which points over an angle are meant to repeat. [-]"""
LEAST_PROBABILITY = 2.0**-53
"""Smallest probability for quantiles of a normal distribution, which are infinite at 0."""

SAME_TORQUE = 1e-13
"""Largest relative difference between a torque and the torque that determined its efficiency."""
LEAST_EFFICIENCY = 1e-6
"""Smallest efficiency in the search for mutually consistent torques and efficiencies."""

# matrices
INDEPENDENT_MOTION = 1e-9
"""Singular value above which a direction is independent, relative to the largest."""
BEARING_MOTION = INDEPENDENT_MOTION * 1e-3
"""`INDEPENDENT_MOTION` for constraints divided by weights, which differ by powers of ten."""
ROUNDED_MOTION = 1e-12
"""Component of a motion that counts as rounding error."""
MOVING_LINK = 1e-9
"""Speed of a link, in a normalised motion, below which the link counts as at rest."""
DEPENDENT = 1e-12
"""Singular value that counts as rounding error in least squares, relative to the largest."""
LIGHT_MOTION = 1e-13
"""Inertia of a motion that counts as 0, relative to the largest inertia."""
RIGID_SQUARE = 1e-10
"""Squared frequency below which a motion is rigid, relative to the largest."""
LEAST_MASS = 1e-30
"""Substitute for a zero mass under a root. [kg*m^2]"""
NOT_ZERO = 1e-300
"""Substitute for a zero divisor."""

# columns over time
CHORD = 8e-4
"""Largest distance of a column from the lines between its instants, relative to its range.

A distance of 1e-3 is visible.
"""
NO_RANGE = 1e-9
"""Largest range of a column that counts as constant, relative to the largest value of its kind."""
EQUAL_EXTREMES = 1e-7
"""Largest relative difference of extremes that count as equal: the accuracy of polynomials."""

# difference quotients
CHANGE_STEP, LONGEST_CHANGE_STEP = 1e-6, 1e-5
"""Interval of differences along a motion relative to the duration, and its upper limit in s.

With these intervals, nine digits of a jerk are correct.
"""
NO_CHANGE = 1e-14
"""Change of a sum that counts as rounding error, relative to the terms of the sum."""
DIFFERENCE_STEP = 1e-6
"""Step of difference quotients, relative to the largest speed."""
NEWTON_STEP = 1e-13
"""Relative step below which Newton's method has converged."""
LEAST_SENSE = 1e-6
"""Smallest assumed derivative of a torque with respect to its rate, relative to the largest."""
NO_SENSE = 1e-30
"""Assumed derivative of a torque with respect to its rate if all are 0. [N*m*s/rad]"""
STRAIGHT_BALANCE = 1e-12
"""Largest component of a nonlinear torque along a motion that counts as 0."""

# stretches of time, solved in closed form
SHORTEST_PART = 2.0**-14
"""Smallest factor on the length of a part when nonlinear torques do not fit."""
FITTING_TORQUE = 1e-12
"""Largest error of the polynomials of torques, relative to the largest torque."""

# Tarasik's published method
PUBLISHED_RTOL = 1e-12
"""Lower limit on the relative tolerance of integration in Tarasik's published method."""
NO_COEFFICIENT = 1e-9
"""Coefficient of a motion that counts as 0, relative to the largest coefficient."""

# iterations
LAST_BIT = 2e-16
"""Relative step at which the iteration of a speed ends."""
