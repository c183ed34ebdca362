"""Largest torque of a transmission after its clutch is dumped, in closed form.

All inertias are reduced to a single shaft with a spring of compliance E. The clutch and the tyres
stick or slip. The torque of a slipping clutch is 0.8 of its breakaway torque:

    J1 engine --clutch-- J2 disc, J3 transmission --E-- J4 wheels --grip-- J5 vehicle

Between two events the torque of the spring oscillates about a mean, so its largest value follows
from the torque and the rate of twist at the first event. If the torque reaches the limit at which
the clutch or the tyres break away, the next oscillation begins.

Source: I. S. Tsitovich, V. B. Algin, Vehicle dynamics (1981), 3.3, table 3.6, figure 3.3, with the
equation numbers of the book. Its cases A, Б, В are A, B, V here.
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
"""Course of a clutch dump.

A: the clutch always slips. B: the clutch grabs at once and sticks. V: the clutch grabs and breaks
away later. A1, B1: the wheels are clamped. A2, B2: the wheels roll. A3, B3: the wheels spin.
V1: the tyres grip. V2: the tyres break away after the clutch. V3: the tyres break away first.
"""
Contact = Literal["grip", "clutch"]
"""The tyres on the road (`grip`) or the clutch, which stick or slip."""
Slips = tuple[Contact, ...]
"""Slipping contacts, in the order in which they began to slip."""

_CASES: Mapping[tuple[bool, Slips], tuple[DumpCase, DumpCase]] = {
    (False, ("clutch",)): ("A2", "A1"),
    (False, ("clutch", "grip")): ("A3", "A3"),
    (True, ()): ("B2", "B1"),
    (True, ("grip",)): ("B3", "B3"),
    (True, ("clutch",)): ("V1", "V1"),
    (True, ("clutch", "grip")): ("V2", "V2"),
    (True, ("grip", "clutch")): ("V3", "V3"),
}
"""Cases for rolling and clamped wheels, by a flag for a grabbing clutch and slipping contacts."""

DUMP_FORM = "vstatics-dump"
"""Name of the JSON format of answers about clutch dumps."""
FIRST_APPROXIMATION = 1.5
"""Initial speed divided by the rate of twist at an event, in table 3.6 of the source. [-]"""

MARGINS: Mapping[DumpCase, str] = {"B3": "2 to 4", "V2": "17 to 23", "V3": "2 to 4"}
"""Excess of the closed form over a numerical integration, for the vehicles of table 3.8. [%]"""


class DumpTorque(NamedTuple):
    """Largest torques after a clutch dump, reduced to the shaft of the spring."""

    case: DumpCase
    max_torque: float
    """Largest torque of the spring. [N*m]"""
    max_torque_simplified: float
    """Largest torque of the spring by the first approximation of table 3.6. [N*m]"""
    input_shaft_torque: float
    """Torque between disc J2 and transmission J3 at `max_torque`, (3.16). [N*m]"""
    input_shaft_torque_simplified: float
    """Torque between disc J2 and transmission J3 at `max_torque_simplified`. [N*m]"""
    dynamic_factor: float
    """Ratio of `max_torque` to the torque of the slipping clutch, as in table 3.16. [-]"""
    dynamic_factor_of_least: float
    """Ratio of `max_torque` to the smaller breakaway torque, of clutch or tyres, (3.4). [-]"""
    grip_ratio: float
    """Clutch breakaway torque M_C0 divided by tyre breakaway torque M_phi, (3.1). [-]"""
    clutch_breaks_at: float
    """Torque of the spring above which a sticking clutch slips. [N*m]"""
    tyres_break_at: float
    """Torque of the spring above which the tyres slip; infinite if the tyres always grip. [N*m]"""
    grabs_below: float
    """Engine speed below which the clutch grabs and sticks at once. [rad/s]"""
    engagement: Sometimes[Engagement] = None
    """Dynamic factor of a gradual engagement, if a rate is specified."""
    messages: tuple[Message, ...] = ()


@document(DUMP_FORM)
class DumpAnswer(NamedTuple):
    """JSON document of the largest torques in a clutch dump whose numbers are in a file."""

    made: Flat[DumpTorque]


class Swing(NamedTuple):
    """Oscillation of the torque of the spring between two events."""

    level: float
    """Mean torque of the oscillation. [N*m]"""
    torque_by_speed: float
    """Amplitude of the torque divided by the amplitude of the rate of twist. [N*m*s/rad]

    It is 1/(K E) for the natural frequency K and the compliance E of the spring.
    """

    def largest(self, torque: float, speed: float) -> float:
        """Return the largest torque [N*m] for an initial torque and rate of twist."""
        return self.level + self._amplitude(torque, speed)

    def speed_at(self, limit: float, torque: float, speed: float) -> float | None:
        """Return the rate of twist [rad/s] when the torque reaches a limit, None if it cannot."""
        rise, amplitude = limit - self.level, self._amplitude(torque, speed)
        radicand = (amplitude - rise) * (amplitude + rise)
        if radicand < 0 or not self.torque_by_speed:
            return None
        return math.sqrt(radicand) / self.torque_by_speed

    def _amplitude(self, torque: float, speed: float) -> float:
        return math.hypot(speed * self.torque_by_speed, torque - self.level)


@refusing()
def dump(given: Dump, rate: float | None = None) -> DumpTorque:
    """Calculate the largest torques after a clutch is dumped.

    Parameters
    ----------
    given : Dump
    rate : float, optional
        Rate K with which the torque of the clutch grows as ``1 - exp(-K t)``, for the dynamic
        factor of (3.70). [1/s]

    Returns
    -------
    DumpTorque
        Largest torques [N*m], case of table 3.6, and dynamic factors [-].

    Raises
    ------
    CaseError
        If a number is not finite and above 0. J3 and J4 may be 0; J4, J5 and M_phi may be infinite.

    Examples
    --------
    ZIL-130 in gear I, on the propshaft; the book has 5.441 kN*m in case Б3.

    >>> result = dump(Dump(54.3, 1.77, 1.79, 1.36, 58.3, 713e-6, 6101, 3760, 45))
    >>> result.case, round(result.max_torque), round(result.dynamic_factor, 3)
    ('B3', 5444, 1.115)
    """
    problems = [*dump_problems(given), *rate_problems(rate)]
    if problems:
        raise CaseError(problems)
    course = _followed(given)
    case, torque = course.case, course.torque
    simplified = _simplified(given, case)
    result = DumpTorque(
        case,
        torque,
        simplified,
        _input_shaft_torque(given, case, torque),
        _input_shaft_torque(given, case, simplified),
        torque / given.slipping_torque,
        torque / min(given.M_C0, given.M_phi),
        given.M_C0 / given.M_phi,
        given.clutch_limit,
        given.grip_limit,
        given.boundary_speed,
        None if rate is None else engagement(rate, given.J2 + given.J3, given.E),
    )
    if not all(math.isfinite(value) for value in result[1:6]):
        raise CaseError("E501", "the numbers are too large or too small to give a torque")
    return result._replace(messages=tuple(_messages(given, result, course)))


class _Course(NamedTuple):
    """Sequence of events in a clutch dump."""

    case: DumpCase
    torque: float
    """Largest torque. [N*m]"""
    missed: DumpCase | None = None
    """Case that would follow if the torque in closed form reached `limit`."""
    limit: float = math.inf
    """Torque at which the missed case would begin. [N*m]"""


def _followed(given: Dump) -> _Course:
    """Follow the events up to an oscillation in which neither clutch nor tyres break away."""
    grabs = given.boundary_speed > given.omega1
    slips: Slips = () if grabs else ("clutch",)
    torque, speed = 0.0, given.omega1 if grabs else 0.0
    limits: dict[Contact, float] = {"grip": given.grip_limit, "clutch": given.clutch_limit}
    while True:
        swing = _swing(given, slips, given.M_C0 if grabs else given.slipping_torque)
        largest, case = swing.largest(torque, speed), _CASES[grabs, slips][given.clamped]
        sticking = [contact for contact in limits if contact not in slips]
        breaks = min(sticking, key=limits.__getitem__, default=None)
        if breaks is None or not largest > limits[breaks]:
            return _Course(case, largest)
        # By (3.52) and (3.61), a later oscillation begins at its mean torque.
        at_limit = swing.speed_at(limits[breaks], swing.level if torque else 0.0, speed)
        if at_limit is None:
            return _Course(case, largest, _CASES[grabs, (*slips, breaks)][0], limits[breaks])
        slips, torque, speed = (*slips, breaks), limits[breaks], at_limit


def _swing(given: Dump, slips: Slips, clutch_torque: float) -> Swing:
    """Return the oscillation of the torque while the contacts `slips` slip."""
    near, far = given.J2 + given.J3, given.J4
    near += given.J1 * ("clutch" not in slips)
    far += given.J5 if "grip" not in slips else 0.0
    level = clutch_torque * _share(far, near) if "clutch" in slips else 0.0
    level += given.M_phi * _share(near, far) if "grip" in slips else 0.0
    return Swing(level, math.sqrt(near * _share(far, near) / given.E))


def _share(inertia: float, other: float) -> float:
    """Return the share of an inertia, which can be infinite, in the sum of both [-]."""
    return 1.0 if math.isinf(inertia) else inertia / (inertia + other)


def _simplified(given: Dump, case: DumpCase) -> float:
    """Calculate the largest torque by the first approximation of table 3.6 [N*m]."""
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


def _input_shaft_torque(given: Dump, case: DumpCase, torque: float) -> float:
    if case.startswith("B"):  # by table 3.6; (3.16) is for a slipping clutch
        return torque * (given.J1 + given.J2) / (given.J1 + given.J2 + given.J3)
    clutch_torque = given.slipping_torque if case.startswith("A") else given.M_C0
    return (clutch_torque * given.J3 + torque * given.J2) / (given.J2 + given.J3)


def _messages(given: Dump, result: DumpTorque, course: _Course) -> Iterator[Message]:
    case = result.case
    if not case.startswith("A"):  # B, V: the clutch grabs at once
        margin = ""
        if case in MARGINS:
            of_integration = f"{MARGINS[case]} % compared with a numerical integration"
            margin = f", by {of_integration} for the vehicles of the source"
        if case == "V2":
            margin += "; by 42 % compared with a measurement (table 3.2)"
        yield Message("N501", f"case {case} gives a torque that is too high{margin}")
    if course.missed is not None:
        yield Message(
            "N502",
            f"case {course.missed} does not occur, because its formula gives a torque below "
            f"{course.limit:.6g}; case {case} applies",
        )
    if given.clamped and case == "V1":
        stuck = _swing(given, (), 0.0).largest(0.0, given.omega1)
        yield Message("N503", f"a clutch that keeps sticking has the torque {stuck:.6g} (case B1)")
    if result.engagement is not None and case not in ("A1", "A2"):
        yield Message(
            "N504",
            "the dynamic factor of --rate is valid for a slipping clutch and gripping tyres only",
        )
