"""Status of a gear: regular, or the reason why speeds, torques or efficiency do not exist."""

from __future__ import annotations

from vstatics.core.numerics.traced import Number, absolute
from vstatics.core.start import NamedTuple


class Status(NamedTuple):
    """Status of a gear: regular, or the fault or state that prevents results."""

    name: str
    """Name in tables and in the output of sweeps. Programs may depend on it."""
    english: str
    """Name in sentences and pictures."""
    meaning: str
    """Clause that explains the status to users."""
    is_fault: bool = False
    """True if the status is a fault of the gear, not an intended state."""
    has_power: bool = False
    """True if power can flow in spite of the status."""


OK = Status("", "", "", has_power=True)
TIED_UP = Status(
    "tied up",
    "tied up",
    "the engaged shift elements contradict each other, so the input cannot turn",
    is_fault=True,
)
CONFLICT = Status(
    "conflict",
    "freewheels in conflict",
    "a freewheel can neither hold nor overrun",
    is_fault=True,
)
OUTPUT_STANDS = Status(
    "output stands",
    "the output is at rest",
    "its speed is 0, so there is no ratio",
    has_power=True,
)
NEUTRAL = Status(
    "open",
    "neutral",
    "the speed of the output is not determined",
    has_power=True,
)
NO_TORQUES = Status(
    "no torques",
    "torques do not balance",
    "the torques on the links cannot balance; a warning says why",
)
LOCKED = Status(
    "locked",
    "self-locking",
    "friction holds the gear train, whatever the driving torque",
    is_fault=True,
)
DRAGGED = Status(
    "dragged",
    "back-driven",
    "losses take more than the input gives, so power enters at the output",
    has_power=True,
)
UNDECIDED = Status(
    "undecided",
    "losses not found",
    "torques with losses are not known; a warning says why",
)

STATUSES = (TIED_UP, CONFLICT, LOCKED, OUTPUT_STANDS, NEUTRAL, NO_TORQUES, DRAGGED, UNDECIDED)
"""All statuses but `OK`, faults first."""


def statuses(  # noqa: PLR0913
    *,
    tied_up: bool,
    conflict: bool,
    output_speed: Number,
    balanced: bool,
    locked: bool,
    undecided: bool,
    dragged: bool = False,
    missing: int = 1,
) -> list[Status]:
    """Return the statuses of a gear, causes before effects; names as in `Results`.

    Parameters
    ----------
    output_speed : Number
        Speed of the output link. [-]
    missing : int
        Number of constraints that the speeds lack. If this is 0 but the output speed is
        indeterminate, the speed ratio of a converter is unknown, and the gear is not neutral.

    Examples
    --------
    >>> [one.name for one in statuses(tied_up=False, conflict=False, output_speed=float("nan"),
    ...                               balanced=False, locked=False, undecided=False)]
    ['open', 'no torques']
    """
    marks = {
        TIED_UP: tied_up,
        CONFLICT: conflict,
        OUTPUT_STANDS: output_speed == 0,
        NEUTRAL: bool(missing) and not absolute(output_speed) >= 0,
        NO_TORQUES: not balanced,
        LOCKED: locked,
        DRAGGED: dragged,
        UNDECIDED: undecided,
    }
    return [status for status, holds in marks.items() if holds]
