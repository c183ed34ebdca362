"""Tolerances of torsional systems, in addition to the tolerances of `numerics`."""

from __future__ import annotations

# modes
REAL_EIGENVALUE = 1e-12
"""Largest imaginary part of an eigenvalue that counts as real, relative to its modulus."""
SAME_MODULUS = 1e-9
"""Relative difference up to which moduli of eigenvalues, or parts in a mode, count as equal."""
LAST_EIGENVALUE_STEP = 1e-8
"""Relative step of an eigenvalue after which the iteration ends, as convergence is quadratic."""
LOST_SQUARE = 1e-4
"""Relative size of a squared frequency below which it has fewer correct digits than its root."""
BELOW_SQUARES = 1e-3
"""Shift below 0 of the iteration for the lowest modes, relative to the lowest square."""
LEAST_SHOWN_PART = 0.0005
"""Smallest share that tables show apart from 0; JSON and CSV have all digits."""

LEAST_PARTICIPATION = 1e-9
"""Smallest relative amplitude of a link that can excite a mode."""

# variants
APART = 1e-9
"""Square root of the share in the energy of a mode above which a device or body takes part."""
LOST_PIVOT = 1e-6
"""Measure of regularity, relative to the first variant, up to which a lower rank is possible."""
RESIDUE = 1e-11
"""Largest residue of a satisfied equation, relative to the largest coefficient times unknown."""
NO_ROW = 1e-300
"""Assumed largest coefficient of an empty equation, to avoid division by zero."""

# the secular equation
LAST_STEP = 1e-13
"""Relative step of a root after which the iteration ends, as convergence is quadratic."""
SAME_SQUARE = 1e-14
"""Relative difference up to which squared frequencies count as equal."""
LOST_WEIGHT = 1e-32
"""Share in the sum of weights up to which a weight counts as a rounding error of the twists."""
AT_POLE = 1e-200
"""Smallest distance of a root from the pole below, relative to the gap between poles."""
AT_NEXT_POLE = 1e-16
"""Smallest distance of a root from the pole above, relative to the gap between poles."""

# forced vibration, engagement
SAME_ORDER = 1e-12
"""Relative difference up to which an order counts as equal to a fraction."""
SAME_ANGLE = 1e-15
"""Difference up to which angles count as equal. [rad]"""
LEAST_RATE = 1e-99
"""Rate of a clutch, relative to the natural frequency, below which the factor is constant."""

# random vibration
NEVER_DAMPED = 1e-12
"""Largest magnitude of the real part of an undamped eigenvalue, relative to the largest one."""
UNMOVED = 1e-9
"""Sum, relative to the sum of absolute terms, up to which it counts as a rounding error."""
WHOLE = 1e-9
"""Difference from 1 allowed for a sum of shares."""
ACCURACY = 1e-10
"""Relative accuracy of integrals."""
NOTHING = 1e-300
"""Absolute accuracy of integrals, so small that only a variance of 0 satisfies it. [unit^2]"""

# records
UNDAMPED = 1e-6
"""Largest magnitude of a negative decrement that counts as a rounding error of 0. [-]"""

# operating points and integrals
SAME_INPUT_TORQUE = 1e-9
"""Relative difference up to which the torques of load and pump count as equal. [-]"""
ROUGH_ACCURACY = 1e-3
"""Relative accuracy of the first integral, which determines the size of each component."""
SPEED_RATIO_STEP = 1e-15
"""Accuracy of the speed ratio of a converter at its working point. [-]"""
SECANT_STEP = 1e-6
"""Relative distance of the first two points of the secant method."""
SETTLED_FRICTION = 1e-12
"""Relative change of a torque of dry friction below which the iteration has settled. [-]"""
ACCEPTED_FRICTION = 1e-9
"""Relative error of a torque of dry friction that is accepted after the last step. [-]"""
STUCK_TORQUE = 1e-9
"""Relative amount by which a torque must be below the dry friction to count as stuck. [-]"""
NO_FRICTION = 1e-300
"""Smallest divisor of a friction torque, which avoids a division by 0."""
SINGULAR = 1e-14
"""Number on the diagonal of the equations of dry friction that keeps them solvable."""
