"""Declaration of the key `bearings` of a case, with checks."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from vstatics.core.errors import Problem, quoted
from vstatics.core.model.carried import CaseKey
from vstatics.core.model.fields import TransmissionFields
from vstatics.core.model.part_checks import no_unit
from vstatics.core.model.shape import NUMBER, TEXT, ByForm, ByKey, ByName, KeyShape, Leaf, ListOf
from vstatics.core.model.torsional_checks import above_0
from vstatics.core.model.torsional_keys import ABOVE_0
from vstatics.vehicle.case.bearing import ROLLER_EXPONENT, Bearing
from vstatics.vehicle.case.members import Members

BEARING = ByKey(
    "Bearing",
    "A rolling bearing, whose load is proportional to a torque, for `vstatics summary --duty`.",
    (
        KeyShape(
            "on",
            ByForm(
                "a link, a member such as `P1.planet`, or two links: [first, second]",
                TEXT,
                ListOf(TEXT, "links"),
            ),
            "Link, member or planet with whose speed the bearing turns, a planet against its "
            "carrier; or two links, whose speeds it has to each other.",
            required=True,
            examples=("P1.planet", ["sun", "carrier"]),
        ),
        KeyShape(
            "torque_of",
            TEXT,
            "Link or member whose torque loads the bearing; by default that of `on`.",
            examples=("P1.carrier",),
        ),
        KeyShape(
            "load_per_torque",
            Leaf("load_per_torque"),
            "Load divided by the magnitude of the torque, in N/(N*m).",
            required=True,
            limits=ABOVE_0,
            examples=("12 N/(N*m)",),
        ),
        KeyShape(
            "dynamic",
            Leaf("force"),
            "Dynamic load rating, in N.",
            required=True,
            limits=ABOVE_0,
            examples=("24 kN",),
        ),
        KeyShape(
            "exponent",
            NUMBER,
            "Life exponent: 3 of ball bearings, 10/3 of roller bearings.",
            default=ROLLER_EXPONENT,
            limits=ABOVE_0,
            examples=(3,),
        ),
    ),
    lambda on, **others: Bearing(on if isinstance(on, str) else tuple(on), **others),
)
WEAKEST_BEARING = 500.0
"""Least plausible dynamic load rating of a bearing in a transmission. [N]"""


def of_bearings(case: TransmissionFields) -> Iterator[Problem]:
    """Yield errors in the bearings of a case."""
    members = Members.of(case)
    for number, (name, bearing) in enumerate(Bearing.of(case).items(), 1):
        path = ("bearings", number)
        yield from _of_places(bearing, members, (*path, "on"))
        owner = bearing.torque_owner
        if owner is None or (bearing.torque_of is None and owner in members.planets):
            what = "two links have" if owner is None else f"{quoted(owner)} has"
            message = f"{what} no torque of a single member, expected `torque_of` of {name}"
            yield Problem("E880", message, path)
        elif bearing.torque_of is not None:
            yield from members.without_torque(owner, (*path, "torque_of"))
        for key, what in (
            ("load_per_torque", "a load per torque"),
            ("dynamic", "a load rating"),
            ("exponent", "an exponent"),
        ):
            yield from above_0(getattr(bearing, key), what, (*path, key))


def doubts_of_bearings(case: TransmissionFields) -> Iterator[Problem]:
    """Yield notes about load ratings that probably lack their unit kN."""
    for number, bearing in enumerate(Bearing.of(case).values(), 1):
        if bearing.dynamic < WEAKEST_BEARING:
            yield no_unit(bearing.dynamic, "N", "most bearings", ("bearings", number, "dynamic"))


def _of_places(bearing: Bearing, members: Members, path: tuple[Any, ...]) -> Iterator[Problem]:
    if isinstance(bearing.on, str):
        yield from members.unknown(bearing.on, path)
        yield from members.at_rest(bearing.on, path)
        return
    if len(bearing.on) != 2:
        message = f"read {len(bearing.on)} links, expected two: [first, second]"
        yield Problem("E880", message, path)
    elif bearing.on[0] == bearing.on[1]:
        message = f"{quoted(bearing.on[0])} does not turn against itself, expected two links"
        yield Problem("E880", message, path)
    for place, link in enumerate(bearing.on, 1):
        if link not in (known := ["housing", *members.links]):
            yield members.fault(link, known, "link", (*path, place))


def _record(case: TransmissionFields) -> dict[str, Any]:
    return {
        name: {
            **bearing._asdict(),
            "on": bearing.on if isinstance(bearing.on, str) else [*bearing.on],
        }
        for name, bearing in Bearing.of(case).items()
    }


KEY = CaseKey(
    KeyShape("bearings", ByName("bearing", BEARING), "Rolling bearings, each under its name."),
    Mapping[str, Bearing],
    _record,
    of_bearings,
    doubts_of_bearings,
    names_members=True,
)
