"""Tolerances of torsional vibration, in addition to the tolerances of `numerics`."""

from __future__ import annotations

# modes
REAL_EIGENVALUE = 1e-12
"""Largest imaginary part of an eigenvalue that counts as real, relative to its modulus."""
SAME_MODULUS = 1e-9
"""Relative difference up to which moduli of eigenvalues, or shares of modes, count as equal."""
LAST_EIGENVALUE_STEP = 1e-8
"""Relative step of an eigenvalue at which the iteration ends, as convergence is quadratic."""
LOST_SQUARE = 1e-4
"""Squared frequency, relative to the largest, below which a more accurate method is used."""
BELOW_SQUARES = 1e-3
"""Negative shift in the iteration for the lowest modes, relative to the lowest square."""
LEAST_SHOWN_PART = 0.0005
"""Smallest share or relative amplitude that tables do not print as 0. [-]"""

LEAST_PARTICIPATION = 1e-9
"""Smallest amplitude of a link at which a torque on it excites a mode, relative to the largest."""

# variants
APART = 1e-9
"""Square root of an energy share above which a component or body takes part in a mode."""
LOST_PIVOT = 1e-6
"""Determinant of an equation block that can mean a lower rank, relative to the first variant."""
RESIDUE = 1e-11
"""Largest residual of a satisfied equation, relative to the largest term."""
NO_ROW = 1e-300
"""Assumed largest coefficient of an equation without coefficients, to avoid division by 0."""

# the secular equation
LAST_STEP = 1e-13
"""Relative step of a root at which the iteration ends, as convergence is quadratic."""
SAME_SQUARE = 1e-14
"""Relative difference up to which squared frequencies count as equal."""
LOST_WEIGHT = 1e-32
"""Weight that counts as rounding error, relative to the sum of all weights."""
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
"""Rate of a clutch, divided by the natural frequency, below which the factor is constant."""

# random vibration
NEVER_DAMPED = 1e-12
"""Largest magnitude of the real part of an undamped eigenvalue, relative to the largest of all."""
UNMOVED = 1e-9
"""Largest sum that counts as rounding error, relative to the sum of magnitudes of its terms."""
WHOLE = 1e-9
"""Largest difference from 1 of a sum of shares."""
ACCURACY = 1e-10
"""Relative accuracy of integrals."""
NOTHING = 1e-300
"""Absolute accuracy of integrals, so small that it only matters if an integral is 0. [unit^2]"""

# records
UNDAMPED = 1e-6
"""Largest magnitude of a negative decrement that counts as rounding error of 0. [-]"""

# operating points and integrals
SAME_INPUT_TORQUE = 1e-9
"""Relative difference up to which torques of load and pump count as equal. [-]"""
ROUGH_ACCURACY = 1e-3
"""Relative accuracy of a rough integral, which scales the components of the final integral. [-]"""
SPEED_RATIO_STEP = 1e-15
"""Accuracy of the speed ratio of a converter at an operating point. [-]"""
SECANT_STEP = 1e-6
"""Relative distance of the first two points of the secant method."""
SETTLED_FRICTION = 1e-12
"""Relative change of a friction torque below which the iteration has converged. [-]"""
ACCEPTED_FRICTION = 1e-9
"""Relative error of a friction torque that is accepted after the last step. [-]"""
STUCK_TORQUE = 1e-9
"""Relative distance below the friction torque at which a spring counts as stuck. [-]"""
NO_FRICTION = 1e-300
"""Smallest divisor of a friction torque, which avoids a division by 0."""
SINGULAR = 1e-14
"""Number added to the diagonal of the equations of dry friction, for regularity."""
