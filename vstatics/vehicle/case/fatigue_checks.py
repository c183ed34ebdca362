"""Checks of the fatigue strengths of a case."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import get_args

from vstatics.core.errors import Path, Problem, listed, quoted
from vstatics.core.model.fields import TransmissionFields
from vstatics.core.model.part_checks import no_unit
from vstatics.core.model.parts import element_names, mechanism_names
from vstatics.core.model.springs import spring_names
from vstatics.core.model.torsional_checks import above_0, not_negative
from vstatics.core.suggestions import nearest
from vstatics.vehicle.case.fatigue import Fatigue, Flanks, TorqueStrength
from vstatics.vehicle.case.members import Members

WEAKEST_METAL = 1e5
"""Endurance limit below which MPa was probably meant; metals have 10 MPa or more. [Pa]"""
THICKEST_SHAFT = 1.0
"""Shaft diameter above which the value was probably given in mm without a unit. [m]"""
_STRENGTHS = {
    "endurance": "an endurance",
    "exponent": "an exponent",
    "cycles": "a number of cycles",
    "diameter": "a diameter",
    "section_modulus": "a section modulus",
    "sum": "a sum of damages",
    "torque": "a torque",
    "contacts": "a number of contacts",
}
_PARTS = {"asymmetry": "an asymmetry", "threshold": "a threshold"}


def of_fatigue(case: TransmissionFields) -> Iterator[Problem]:
    """Yield errors in the fatigue strengths of a case."""
    names = [*element_names(case.shift_elements), *mechanism_names(case.mechanisms)]
    names += spring_names(case.springs)
    paths: dict[str, Path] = {
        name: ("fatigue", number) for number, name in enumerate(case.fatigue, 1)
    }
    yield from _of_members(case, paths)
    for name, fatigue in Fatigue.of(case).items():
        path = paths[name]
        if name not in names:
            hint = nearest(name, names) or f"; components are {listed(names, 12) or 'none'}"
            if name in Members.of(case).of_sets:
                hint = "; a member of a gear set needs `torque` instead of `endurance`"
            yield Problem("E880", f"there is no component {quoted(name)}{hint}", path)
        if (fatigue.diameter is None) == (fatigue.section_modulus is None):
            read = "neither `diameter` nor" if fatigue.diameter is None else "both `diameter` and"
            message = f"read {read} `section_modulus`, expected one of them"
            yield Problem("E881", message, path)
        for key, value in fatigue._asdict().items():
            if key in _PARTS:
                yield from not_negative(value, _PARTS[key], (*path, key))
            elif value is not None:
                yield from above_0(value, _STRENGTHS[key], (*path, key))


def _of_members(case: TransmissionFields, paths: Mapping[str, Path]) -> Iterator[Problem]:
    members = Members.of(case)
    springs = {*spring_names(case.springs)} - {*members.with_torque}
    for name, strength in TorqueStrength.of(case).items():
        path = paths[name]
        member, place = (strength.on or name), (*path, "on") if strength.on else path
        if member in springs:
            message = f"{quoted(member)} is a spring, expected `endurance` instead of `torque`"
            yield Problem("E880", message, place)
            continue
        yield from members.unknown(member, place)
        yield from members.at_rest(member, place)
        owner = strength.torque_of or member
        if owner in members.links and strength.flanks == "apart":
            message = f"the torque of link {quoted(owner)} is a magnitude, the same for both flanks"
            yield Problem("E881", f"{message}: expected a member of a gear set", path)
        if strength.torque_of is not None:
            yield from members.without_torque(strength.torque_of, (*path, "torque_of"))
        elif member in members.planets and member not in members.firsts:
            message = f"{member} is a planet without a torque of its own, expected `torque_of`"
            yield Problem("E880", f"{message}, such as that of its sun", path)
        if strength.flanks not in get_args(Flanks):
            message = f"read {strength.flanks!r}, expected `apart` or `together`"
            yield Problem("E881", message, (*path, "flanks"))
        for key in ("torque", "exponent", "cycles", "sum", "contacts"):
            if (value := getattr(strength, key)) is not None:
                yield from above_0(value, _STRENGTHS[key], (*path, key))
        yield from not_negative(strength.threshold, _PARTS["threshold"], (*path, "threshold"))


def doubts_of_fatigue(case: TransmissionFields) -> Iterator[Problem]:
    """Yield notes about diameters and stresses that probably lack their unit mm or MPa."""
    for name, fatigue in Fatigue.of(case).items():
        if fatigue.endurance < WEAKEST_METAL:
            yield no_unit(fatigue.endurance, "Pa", "a metal", ("fatigue", name, "endurance"))
        if fatigue.diameter and fatigue.diameter > THICKEST_SHAFT:
            yield no_unit(fatigue.diameter, "m", "a shaft", ("fatigue", name, "diameter"))
