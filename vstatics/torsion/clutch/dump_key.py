"""Key `dump` of a case, with its checks."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial

from vstatics.core.errors import Problem
from vstatics.core.model.carried import CaseKey
from vstatics.core.model.fields import TransmissionFields
from vstatics.core.model.part_checks import called, expect, of_link
from vstatics.core.model.shape import LINK, ByKey, KeyShape, Leaf, ListOf
from vstatics.core.model.torsional_keys import ABOVE_0
from vstatics.torsion.clutch.clutch_dump import MASSES, NEEDED, NUMBERS, ClutchDump, dump_record

_PARTS = {
    "J1": "the engine and the driving parts of the clutch",
    "J2": "the driven disc",
    "J3": "the transmission",
    "J4": "the wheels",
    "J5": "the vehicle",
}

DUMP = ByKey(
    "Clutch dump",
    "Masses, torques and speed of a clutch dump, for `vstatics torsion dump`.",
    (
        *(
            KeyShape(
                name,
                ListOf(LINK, "links"),
                f"Links of {_PARTS[name]}; their inertias are reduced and added.",
                required=name in NEEDED,
                limits={"minItems": 1} if name in NEEDED else {},
            )
            for name in MASSES
        ),
        KeyShape(
            "M_C0",
            Leaf("si_torque"),
            "Torque at which the clutch breaks away, on the first link of J2, in N*m.",
            required=True,
            limits=ABOVE_0,
        ),
        KeyShape(
            "M_phi",
            Leaf("si_torque", infinite=True),
            "Torque of all wheels on the first link of J4 at which the tyres lose their grip, in "
            "N*m; when not given, they keep it.",
            limits=ABOVE_0,
        ),
        KeyShape(
            "omega1",
            Leaf("si_speed"),
            "Speed of the first link of J1 before the dump, in rad/s.",
            required=True,
            limits=ABOVE_0,
        ),
        KeyShape(
            "E",
            Leaf("compliance"),
            "Compliance from J2 to J5, reduced to the link `to`, in rad/(N*m); calculated from the "
            "elastic components when not given.",
            limits=ABOVE_0,
        ),
        KeyShape(
            "to",
            LINK,
            "Link to which inertias, compliances and torques are reduced; the first of J2 when not "
            "given.",
        ),
    ),
    partial(ClutchDump, J3=(), J4=()),
)


def of_dump(case: TransmissionFields) -> Iterator[Problem]:
    """Yield problems of a dump: missing, unknown or repeated links, and numbers out of range."""
    dump = ClutchDump.of(case)
    if dump is None:
        return
    seen: dict[int, str] = {}
    for name, links in dump.masses.items():
        if not links and name in NEEDED:
            yield Problem("E259", "read no link, expected at least one", ("dump", name))
        for number, link in enumerate(links, 1):
            path = ("dump", name, number)
            yield from of_link(link, path, case.own_links, lowest=1)
            if link in seen:
                yield Problem(
                    "E260",
                    f"link {called(case, link)} is already in {seen[link]}"
                    ", expected each link once",
                    path,
                )
            seen.setdefault(link, name)
    if dump.to is not None:
        yield from of_link(dump.to, ("dump", "to"), case.own_links, lowest=1)
    for name in NUMBERS:
        value = getattr(dump, name)
        if value is not None:
            is_valid = value > 0 and (value < math.inf or name == "M_phi")
            yield from expect(value, "a number above 0", ("dump", name), right=is_valid)


KEY = CaseKey(
    KeyShape("dump", DUMP, "A clutch that is dumped, for `vstatics torsion dump`."),
    ClutchDump | None,
    dump_record,
    of_dump,
)
