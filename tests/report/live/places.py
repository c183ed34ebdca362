"""Places of the sliders of a case, and what the program makes of the case there."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import replace
from random import Random
from typing import Any

from vstatics import CaseError, Transmission, solve
from vstatics.elements.drawing import drawing_of
from vstatics.flow.power import flows
from vstatics.flow.power_flow import PowerFlow
from vstatics.model.parts import OfLoad
from vstatics.report.live.fields import PageField
from vstatics.sweep.variants.part_numbers import part_numbers, with_part_numbers
from vstatics.tables import values


def place(fields: Iterable[PageField], chance: Random) -> dict[str, float]:
    """Places of some sliders, from end to end: all of them, or near where they stand."""
    near = chance.random() < 0.7
    return {one.path: _moved(one, chance, near=near) for one in fields}


def _moved(field: PageField, chance: Random, *, near: bool) -> float:
    low, high = field.limits
    moved = chance.uniform(low, high)
    if near:
        turned = chance.choice([1, 1, 1, -1]) if low < 0 else 1
        moved = min(max(turned * field.value * chance.uniform(0.8, 1.25), low), high)
    return round(moved) if field.whole else moved


def with_numbers(case: Transmission, numbers: Mapping[str, float]) -> Transmission:
    """The case with other numbers at their paths, checked as any other.

    Raises
    ------
    CaseError
        If there is no such case.
    """
    known, gears = part_numbers(case), list(case.gears)
    parts = {path: number for path, number in numbers.items() if path in known}
    if parts:
        case = with_part_numbers(case, [known[path] for path in parts], [*parts.values()])
    rest = {path: number for path, number in numbers.items() if path not in known}
    for place_of, gear in enumerate(gears):
        own: dict[str, Any] = {"speeds": dict(gear.speeds), "torques": dict(gear.torques)}
        for kind, by_link in own.items():
            for link, given in by_link.items():
                number = rest.pop(f"gears.{gear.name}.{kind}.{case.link_name(link)}", None)
                if number is not None:
                    is_of_load = isinstance(given, OfLoad)
                    by_link[link] = OfLoad(number, given.whole) if is_of_load else number
        gears[place_of] = gear._replace(**own)

    def changed(one: Any, keys: Mapping[str, str]) -> Any:
        found = {field: rest.pop(f"{one.name}.{key}", None) for field, key in keys.items()}
        given = {field: number for field, number in found.items() if number is not None}
        return replace(one, **given) if hasattr(one, "members") else one._replace(**given)

    drawing = drawing_of(case)
    keys = {"efficiency": "efficiency", "back_efficiency": "back_efficiency", "ratio": "ratio"}
    made = [
        changed(one, {**keys, "ratio": "speed_ratio"} if one.kind else keys)
        for one in (drawing.mechanisms if drawing else case.mechanisms)
    ]
    if drawing:
        del keys["ratio"]
        elements = [changed(one, keys) for one in drawing.elements]
        changes: dict[str, Any] = {"drawing": replace(drawing, elements=elements, mechanisms=made)}
    else:
        changes = {"mechanisms": made}
    assert not rest
    return case.replace(gears=gears, **changes)


def program(
    case: Transmission, numbers: Mapping[str, float], *, with_flow: bool = False
) -> list[dict[str, Any]] | None:
    """By gear what the program has at some numbers; None if it refuses them.

    Of each result its rows, whether the gear fails, and its flow of power if asked for.
    """
    try:
        results = solve(with_numbers(case, numbers))
    except CaseError:
        return None
    tables = {one.quantity.key: one.values for one in values.tables(results)}
    fails = results.tied_up | results.conflict | results.locked | results.undecided
    by_gear = flows(results) if with_flow else [None] * len(case.gears)
    return [
        {key: tables[key][:, n].tolist() for key in tables if key != "AJK"}
        | {"fails": bool(fails[n]), "flow": flow}
        for n, flow in enumerate(by_gear)
    ]


def powers(side: PowerFlow | None) -> dict[str, float]:
    """Powers through links, mechanisms, shift elements, and of members, by the rows of a page."""
    if side is None:
        return {}
    kinds = ("link", "mechanism", "element", "drag")
    found = {f"{one.kind} {one}": power for one, power in side.throughput.items()}
    found |= {
        f"mechanism {one.device}.{one.member}": one.power
        for one in side.members
        if one.device.kind == "mechanism" and one.link != "housing"
    }
    return {key: power for key, power in found.items() if key.startswith(kinds)}


def is_equal(a: float | None, b: float | None) -> bool:
    """As the page promises; None and NaN do not exist."""
    one, two = (math.nan if x is None else float(x) for x in (a, b))
    if math.isnan(one) or math.isnan(two):
        return math.isnan(one) and math.isnan(two)
    return abs(one - two) <= 1e-9 * max(1e-3, abs(one), abs(two))
