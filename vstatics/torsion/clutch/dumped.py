"""The largest torque of a transmission when its clutch is dumped: closed forms.

One spring E stands between the inertias, all on one shaft. The clutch and the grip of the
tyres stick or slip; a clutch that slips has 0.8 of the torque at which it breaks away:

    J1 engine --clutch-- J2 disc, J3 transmission --E-- J4 wheels --grip-- J5 vehicle

Between two events the torque swings about a level, so its largest value follows from the
torque and the speed of twist at the last event. Where a swing reaches the torque at which the
clutch or the grip breaks away, the next one begins.

Source: I. S. Tsitovich, V. B. Algin, Vehicle dynamics (1981), 3.3, table 3.6, figure 3.3; its
cases A, Б, В are A, B, V here. Numbers of equations are those of the book.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Literal, NamedTuple

from vstatics.core.arguments import refusing
from vstatics.core.errors import CaseError
from vstatics.core.statics.result_arrays import Message
from vstatics.core.tables.answer import Flat, Sometimes, document
from vstatics.torsion.clutch.engagement import Engagement, engagement, rate_problems
from vstatics.torsion.clutch.given import Dump, dump_problems

DumpCase = Literal["A1", "A2", "A3", "B1", "B2", "B3", "V1", "V2", "V3"]
"""A: the clutch slips throughout. B: it grabs at once and stays stuck. V: it grabs, and breaks
away again. 1 of A and B: the wheels are clamped; 2: they roll; 3: they spin. V1: the tyres
grip; V2: they break away after the clutch; V3: before it."""
Contact = Literal["grip", "clutch"]
"""What sticks or slips."""
Slips = tuple[Contact, ...]
"""What slips, in the order in which it began to."""

_CASES: Mapping[tuple[bool, Slips], tuple[DumpCase, DumpCase]] = {
    (False, ("clutch",)): ("A2", "A1"),
    (False, ("clutch", "grip")): ("A3", "A3"),
    (True, ()): ("B2", "B1"),
    (True, ("grip",)): ("B3", "B3"),
    (True, ("clutch",)): ("V1", "V1"),
    (True, ("clutch", "grip")): ("V2", "V2"),
    (True, ("grip", "clutch")): ("V3", "V3"),
}
"""Whether the clutch grabs, what slips -> the case, with wheels that roll and that are clamped."""

DUMP_FORM = "vstatics-dump"
"""Of all answers about clutches that are dumped."""
FIRST_APPROXIMATION = 1.5
"""Speed at the start by speed of twist at an event, for the simplified forms of table 3.6. [-]"""

MARGINS: Mapping[DumpCase, str] = {"B3": "2 to 4", "V2": "17 to 23", "V3": "2 to 4"}
"""By how many per cent the closed form is above an integration in time of the same scheme, for
the vehicles of table 3.8."""


class DumpTorque(NamedTuple):
    """The largest torques of a clutch that is dumped, on the shaft of the scheme."""

    case: DumpCase
    max_torque: float
    """Of the spring. [N*m]"""
    max_torque_simplified: float
    """The same, by the first approximation of table 3.6. [N*m]"""
    input_shaft_torque: float
    """Between disc and transmission, (3.16). [N*m]"""
    input_shaft_torque_simplified: float
    """The same, of `max_torque_simplified`. [N*m]"""
    dynamic_factor: float
    """`max_torque` by the torque of the clutch that slips, as in table 3.16. [-]"""
    dynamic_factor_of_least: float
    """`max_torque` by the lesser of M_C0 and M_phi, (3.4). [-]"""
    grip_ratio: float
    """M_C0 by M_phi, (3.1). [-]"""
    clutch_breaks_at: float
    """Torque of the spring from which on a clutch that is stuck slips. [N*m]"""
    tyres_break_at: float
    """Torque of the spring from which on the tyres slip; infinite where they grip. [N*m]"""
    grabs_below: float
    """Speed of the engine below which the clutch grabs. [rad/s]"""
    engagement: Sometimes[Engagement] = None
    """If a rate was given."""
    messages: tuple[Message, ...] = ()


@document(DUMP_FORM)
class DumpAnswer(NamedTuple):
    """The largest torques of a file of numbers."""

    made: Flat[DumpTorque]


class Swing(NamedTuple):
    """How the torque of the spring swings between two events."""

    level: float
    """About which it swings. [N*m]"""
    torque_by_speed: float
    """Amplitude of the torque by that of the speed of twist, 1/(K E). [N*m*s/rad]"""

    def largest(self, torque: float, speed: float) -> float:
        """Of the torque, from its value and the speed of twist at the start [N*m]."""
        return self.level + self._amplitude(torque, speed)

    def speed_at(self, limit: float, torque: float, speed: float) -> float | None:
        """Speed of twist where the torque reaches a limit; None where it does not [rad/s]."""
        off, amplitude = limit - self.level, self._amplitude(torque, speed)
        radicand = (amplitude - off) * (amplitude + off)
        if radicand < 0 or not self.torque_by_speed:
            return None
        return math.sqrt(radicand) / self.torque_by_speed

    def _amplitude(self, torque: float, speed: float) -> float:
        return math.hypot(speed * self.torque_by_speed, torque - self.level)


@refusing()
def dump(given: Dump, rate: float | None = None) -> DumpTorque:
    """The largest torques when a clutch is dumped.

    Parameters
    ----------
    given : Dump
    rate : float, optional
        K with which the torque of the clutch grows as ``1 - exp(-K t)``, for the dynamic
        factor of (3.70). [1/s]

    Returns
    -------
    DumpTorque
        Largest torques [N*m], the case of the tables, dynamic factors [-].

    Raises
    ------
    CaseError
        Of numbers that are not above 0 (J3 and J4 may be 0), not a number, or infinite
        (J4, J5 and M_phi may be).

    Examples
    --------
    ZIL-130 in gear I, on the propshaft; the book has 5.441 kN*m in case Б3.

    >>> made = dump(Dump(54.3, 1.77, 1.79, 1.36, 58.3, 713e-6, 6101, 3760, 45))
    >>> made.case, round(made.max_torque), round(made.dynamic_factor, 3)
    ('B3', 5444, 1.115)
    """
    problems = [*dump_problems(given), *rate_problems(rate)]
    if problems:
        raise CaseError(problems)
    course = _followed(given)
    case, largest = course.case, course.torque
    simplified = _simplified(given, case)
    made = DumpTorque(
        case,
        largest,
        simplified,
        _at_input_shaft(given, case, largest),
        _at_input_shaft(given, case, simplified),
        largest / given.slipping_torque,
        largest / min(given.M_C0, given.M_phi),
        given.M_C0 / given.M_phi,
        given.clutch_limit,
        given.grip_limit,
        given.boundary_speed,
        None if rate is None else engagement(rate, given.J2 + given.J3, given.E),
    )
    if not all(math.isfinite(one) for one in made[1:6]):
        raise CaseError("E501", "numbers so large or so small give no torque")
    return made._replace(messages=tuple(_messages(given, made, course)))


class _Course(NamedTuple):
    """What happens."""

    case: DumpCase
    torque: float
    """The largest. [N*m]"""
    missed: DumpCase | None = None
    """What should follow, but by its closed form does not: its radicand is below 0."""
    limit: float = math.inf
    """Torque at which it would follow. [N*m]"""


def _followed(given: Dump) -> _Course:
    """From event to event, up to the swing whose largest torque breaks nothing away."""
    grabs = given.boundary_speed > given.omega1
    slips: Slips = () if grabs else ("clutch",)
    torque, speed = 0.0, given.omega1 if grabs else 0.0
    limits: dict[Contact, float] = {"grip": given.grip_limit, "clutch": given.clutch_limit}
    while True:
        swing = _swing(given, slips, given.M_C0 if grabs else given.slipping_torque)
        largest, case = swing.largest(torque, speed), _CASES[grabs, slips][given.clamped]
        sticks = [one for one in limits if one not in slips]
        breaks = min(sticks, key=limits.__getitem__, default=None)
        if breaks is None or not largest > limits[breaks]:
            return _Course(case, largest)
        # (3.52), (3.61): a swing after an event is taken to begin at its level
        at_limit = swing.speed_at(limits[breaks], swing.level if torque else 0.0, speed)
        if at_limit is None:
            return _Course(case, largest, _CASES[grabs, (*slips, breaks)][0], limits[breaks])
        slips, torque, speed = (*slips, breaks), limits[breaks], at_limit


def _swing(given: Dump, slips: Slips, clutch_torque: float) -> Swing:
    """How the torque swings while these slip."""
    near, far = given.J2 + given.J3, given.J4
    near += given.J1 * ("clutch" not in slips)
    far += given.J5 if "grip" not in slips else 0.0
    level = clutch_torque * _part(far, near) if "clutch" in slips else 0.0
    level += given.M_phi * _part(near, far) if "grip" in slips else 0.0
    return Swing(level, math.sqrt(near * _part(far, near) / given.E))


def _part(one: float, other: float) -> float:
    """Of an inertia, which may be infinite, in its sum with another [-]."""
    return 1.0 if math.isinf(one) else one / (one + other)


def _simplified(given: Dump, case: DumpCase) -> float:
    """The largest torque by the first approximation of a case [N*m]."""
    slipping = case.startswith("A")
    clutch_torque = given.slipping_torque if slipping else given.M_C0
    speed = (given.boundary_speed if slipping else given.omega1) / FIRST_APPROXIMATION
    free = _swing(given, ("clutch", "grip"), clutch_torque)
    match case:
        case "A1" | "A2":  # (3.21)
            return 2 * clutch_torque
        case "B1" | "B2":  # (3.35)
            return _swing(given, (), 0.0).largest(0.0, given.omega1)
        case "B3":  # (3.43)
            return given.M_phi + speed * _swing(given, ("grip",), 0.0).torque_by_speed
        case "V1":  # (3.51)
            return given.M_C0 + speed * _swing(given, ("clutch",), 0.0).torque_by_speed
        case "V3":  # (3.68)
            return free.largest(given.M_C0, speed)
    return free.largest(given.M_phi, speed)  # (3.31), (3.60)


def _at_input_shaft(given: Dump, case: DumpCase, torque: float) -> float:
    """Torque between disc and transmission where the spring has the given one [N*m]."""
    if case.startswith("B"):  # (3.16) has no torque of a clutch that is stuck: table 3.6
        return torque * (given.J1 + given.J2) / (given.J1 + given.J2 + given.J3)
    clutch_torque = given.slipping_torque if case.startswith("A") else given.M_C0
    return (clutch_torque * given.J3 + torque * given.J2) / (given.J2 + given.J3)


def _messages(given: Dump, made: DumpTorque, course: _Course) -> Iterator[Message]:
    """What is to be known of the result."""
    case = made.case
    if not case.startswith("A"):  # it is taken to grab at once: in A nothing is approximated
        by = ""
        if case in MARGINS:
            by = f", by {MARGINS[case]} % of an integration in time, for the vehicles of the source"
        if case == "V2":
            by += "; against the one that was measured by 42 % (table 3.2)"
        yield Message("N501", f"case {case} is on the safe side{by}")
    if course.missed is not None:
        message = f"case {course.missed} does not come: by its closed form the torque does not"
        yield Message("N502", f"{message} reach {course.limit:.6g}; case {case} holds")
    if given.clamped and case == "V1":
        stuck = _swing(given, (), 0.0).largest(0.0, given.omega1)
        yield Message("N503", f"with a clutch that stays stuck the torque is {stuck:.6g} (case B1)")
    if made.engagement is not None and case not in ("A1", "A2"):
        message = "the factor of the engagement is for a clutch that slips and tyres that grip"
        yield Message("N504", message)
