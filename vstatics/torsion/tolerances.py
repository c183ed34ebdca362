"""Tolerances of torsional systems, by what they compare; beside those of `numerics`."""

from __future__ import annotations

# modes
REAL_EIGENVALUE = 1e-12
"""An imaginary part below this part of the modulus is rounding of a real eigenvalue."""
SAME_MODULUS = 1e-9
"""Moduli of eigenvalues, or parts in a mode, that differ by less than this part are the same."""
LAST_EIGENVALUE_STEP = 1e-8
"""A step below this part of the eigenvalue is the last: the next would be its square or less."""
LOST_SQUARE = 1e-4
"""A square below this part of the largest one has lost digits that its root has not."""
BELOW_SQUARES = 1e-3
"""How far below 0 the iteration for the lowest modes stands, by about the lowest square."""
LEAST_SHOWN_PART = 0.0005
"""Parts of 1 that are below are not told apart from 0, but with all digits in JSON and CSV."""

LEAST_PARTICIPATION = 1e-9
"""A link whose amplitude in a mode is below this part of the largest can't excite it."""

# variants
APART = 1e-9
"""A device or body whose energy in a mode is below the square of this part has none in it."""
LOST_PIVOT = 1e-6
"""A pivot below this part of that of the first variant may be one that is zero."""
RESIDUE = 1e-11
"""A sum below this part of the largest coefficient times the largest unknown is zero."""
NO_ROW = 1e-300
"""In place of the largest coefficient of an equation that has none."""

# the secular equation
LAST_STEP = 1e-13
"""A step below this part of the root is the last: the next would be its square."""
SAME_SQUARE = 1e-14
"""Squares that differ by less than this part of them are one."""
LOST_WEIGHT = 1e-32
"""Part of the sum of weights: less is rounding of the twists."""
AT_POLE = 1e-200
"""A root is no nearer than this part of the gap to the pole below it, ..."""
AT_NEXT_POLE = 1e-16
"""... and than this to the pole above."""

# forced vibration, engagement
SAME_ORDER = 1e-12
"""An order is a fraction that differs from it by less than this part."""
SAME_ANGLE = 1e-15
"""Angles as near as that are the same. [rad]"""
LEAST_RATE = 1e-99
"""Of a clutch, by that of the shaft: slower, or faster than its inverse, nothing changes."""

# random vibration
NEVER_DAMPED = 1e-12
"""A real part below this part of the largest eigenvalue is none."""
UNMOVED = 1e-9
"""A sum below this part of its terms is rounding."""
WHOLE = 1e-9
"""Shares add up to 1 within it."""
ACCURACY = 1e-10
"""Of integrals."""
NOTHING = 1e-300
"""A variance that is less is none. [square of a unit]"""

# records
UNDAMPED = 1e-6
"""A decrement below 0 by no more is that of rounding. [-]"""

# operating points and integrals
SAME_INPUT_TORQUE = 1e-9
"""Relative difference up to which the torque of the load is the torque of the pump. [-]"""
ROUGH_ACCURACY = 1e-3
"""Relative accuracy of the first integral, which tells the parts that matter."""
SPEED_RATIO_STEP = 1e-15
"""Accuracy of the speed ratio of a converter at its working point. [-]"""
SECANT_STEP = 1e-6
"""Relative distance of the first two points of the secant method."""
