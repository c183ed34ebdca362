"""Tolerances of a simulation, by what they compare; parts of the largest where nothing is said."""

from __future__ import annotations

# a run
RTOL = 1e-8
"""Of the integration, if nobody says otherwise: so much is left of the energy at most, too."""
LEAST_RTOL = 3e-14
"""The solver refuses less: it would be rounding."""
CLOSED_ENERGY = 1e-8
"""A run closes that leaves no more than this part of the largest energy."""
NO_ENERGY = 1e-12
"""An energy that is none. [J]"""
PRINTED = 1e-9
"""Less than this part of the largest number of its kind is printed as 0."""
CLOSED_BALANCE = 5e-4
"""A balance below it is 0 to three decimals. [J]"""

# numbers that are given
LARGEST_NUMBER = 1e15
"""What is larger, in SI, is mistyped: a ship has 1e9 kg, and turns no faster than 1e2 rad/s."""
LEAST_NUMBER = 1e-15
"""The same of what is smaller: the balance wheel of a watch has 1e-9 kg*m^2."""
UNLIKE_INERTIAS = 1e-12
"""Part of the largest inertia below which another one is rounding."""

# times
SAME_INSTANT = 1e-11
"""Events as near as this part of the duration come at one instant."""
SAME_TIME = 1e-12
"""Times that differ by this part are the same but for rounding."""
SAME_END = 1e-13
"""A stretch that ends so near to the end of a piece ends there."""
AHEAD = 1e-7
"""Part of a duration or a step by which it is looked ahead, and over which slopes are taken."""
SIGHT = 1e-6
"""The same where what changes follows from speeds, whose rounding is larger."""
LONGEST_DURATION = 1e4
"""Times in a run are judged by no longer duration: a motion is as fast in a long run. [s]"""
LEAST_DURATION = 1e-9
"""Slopes are taken over a part of no shorter one. [s]"""
NO_PROGRESS = 1e-5
"""Steps without end, by the duration: what switches to and fro has no longer ones."""
AHEAD_OF_STOP = (0.0, 1e-9, 1e-6, 1e-3)
"""Parts of the duration behind a stop at which a torque may be no number."""
BEYOND_ALL = 1e6
"""A torque at a stop that is larger than all others by this factor is the cause. [-]"""
ROOT_PART = 1e-14
"""A root of a polynomial, by the interval: nearer there is nothing but rounding."""
ROOT_TIME = 1e-15
"""A root by the margin itself, as a part of the time."""

# speeds, torques, margins
STANDING = 1e-9
"""A speed, torque or impulse that is 0 but for rounding, by the largest of its kind."""
NO_MARGIN = 1e-10
"""A margin is below 0 by more than this part of what is large."""
LEAST_VALUE = 1e-30
"""Of a state, beside which others are accurate."""
SMALL_VALUE = 1e-3
"""Part of the largest value of a state up to which it is as accurate."""
BETWEEN_INSTANTS = 1e-9
"""States between the instants of a step are as accurate, by the largest number in it."""
EQUAL_SIDES = 1e-10
"""What is compared is equal if it differs by less than this part."""
SOON = 1e2
"""By so much of what it changes until there a comparison may be equal: times have that rounding."""
MET = 1e-3
"""... and it meets now what it reaches in this part of the time that is looked ahead."""
SLIDING = 1e-3
"""A motion that stays as near to a jump, by the size of the numbers compared, slides along it."""
NEAR_LIMIT = 1e-3
"""A state is at a limit that it reaches in this part of the time that is looked ahead."""
EXACT_SIDES = 1e-13
"""A comparison turns where it is passed by this part of what is compared."""
ROUNDED_INPUT = 1e-14
"""Part of the largest of its kind by which a number that a formula sees is uncertain."""
ROUNDED_SUM = 1e-15
"""Part of the sizes of its terms that rounding leaves of a sum which is 0."""
PASSED_LIMIT = 1e-10
"""A limit is passed by more than this part of the largest torque."""
FALLING_MARGIN = 1e-12
"""A margin that changes less while it is looked ahead stays."""
TIGHT_SLACK = 1e-6
"""Slacks as near to the least, by the largest, are at their limit with it."""
REGULAR_CORNER = 1e-9
"""Limits whose determinant is less do not meet in a corner."""
NO_SPLIT = 1e-12
"""What is left of the goal where no split lies within all limits."""
WITHIN_LIMITS = 1e-6
"""A split may pass limits by this part of the largest slack: so far least squares are accurate."""
SHARED_TORQUE = 1e-6
"""A torque takes part in a redundant direction that has more of it."""
SAME_VALUES = 1e-9
"""Values at one instant that differ by less do not jump."""
MADE_CAPACITY = 1e-9
"""A number may be above the capacity of the case, or below 0, by this part."""
MISSING_MASS = 1e-3
"""Part of the mass of a vehicle that its inertia may lack."""
LEAST_PROBABILITY = 2.0**-53
"""A normal distribution has no number for a part of 0."""

# matrices
INDEPENDENT_MOTION = 1e-9
"""A direction counts that is above this part of the largest."""
BEARING_MOTION = INDEPENDENT_MOTION * 1e-3
"""The same among weighted torques, whose weights differ."""
ROUNDED_MOTION = 1e-12
"""Parts of a motion below this are rounding."""
MOVING_LINK = 1e-9
"""Links whose speeds in a motion are below stand still in it."""
DEPENDENT = 1e-12
"""Singular values below this part of the largest are rounding, in least squares."""
LIGHT_MOTION = 1e-13
"""An inertia of a motion below this part of the largest is none."""
RIGID_SQUARE = 1e-10
"""A square of a frequency below this part of the largest belongs to a rigid motion."""
LEAST_MASS = 1e-30
"""In place of the mass of a motion that has none, under a root. [kg*m^2]"""
NOT_ZERO = 1e-300
"""In place of 0, by which something is divided."""

# curves over time
CHORD = 8e-4
"""Chords between the instants of a run come so near to a column, by its range: people see 1e-3."""
NO_RANGE = 1e-9
"""A column that changes less, by the largest of its kind, does not change but for rounding."""
EQUAL_EXTREMES = 1e-7
"""Extremes that differ by less, by the range, may be equal: polynomials are as accurate."""

# slopes
CHANGE_STEP, LONGEST_CHANGE_STEP = 1e-6, 1e-5
"""Time over which a change along the motion is told, as a part of the duration, and at most [s]:
rounding leaves nine digits of a jerk."""
NO_CHANGE = 1e-14
"""Part of its terms by which a sum changes by rounding alone."""
DIFFERENCE_STEP = 1e-6
"""Step of a difference in place of a slope, by the largest speed."""
NEWTON_STEP = 1e-13
"""A step of Newton's rule that is smaller is the last."""
LEAST_SENSE = 1e-6
"""A torque senses its rate by this part of the largest slope at least, whatever its own is, ..."""
NO_SENSE = 1e-30
"""... and by this where all are 0. [N*m*s/rad]"""
STRAIGHT_BALANCE = 1e-12
"""A torque that bends does not act along a motion if it does so by less."""

# stretches in closed form
ENOUGH_TERMS = 1e-18
"""A term of a series that is smaller, by what it is added to, is the last."""
SHORTEST_PART = 2.0**-14
"""By which a part may be shortened, where torques bend."""
FITTING_TORQUE = 1e-12
"""How near polynomials come to torques, by the largest torque."""

# the published method
PUBLISHED_RTOL = 1e-12
"""The finest tolerance of its integration."""
NO_COEFFICIENT = 1e-9
"""Coefficients of a motion below this part of the largest are 0."""

# iterations
LAST_BIT = 2e-16
"""Relative step of the last iteration of a speed."""
