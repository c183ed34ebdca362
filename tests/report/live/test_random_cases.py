"""The page calculates random cases as the program does: freewheels, converters, drag, edge places.

What is expected is the program's own result for a case with the numbers of a place.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from importlib.resources import files
from random import Random
from typing import Any

import pytest

from tests.chance import count, seeded
from tests.report.live.places import place, program
from tests.report.live.test_core import NOT_TRIED, differ
from tests.trains import random_train
from vstatics import CaseError, Gear, Mechanism, ShiftElement, Transmission
from vstatics.report.live.lowered import lowered
from vstatics.report.live.page import live_fields

EDGES = {
    "ratio": (1, -1, 0, 0.5, 2, 1.00005, 1e-9, 1e9),
    "efficiency": (1, 0, 0.5, 1e-6, 1 - 1e-12),
    "back_efficiency": (0, 1, 1e-6),
    "speeds": (0, 1, -1, 1e-12),
    "torques": (0, 1, -1, 1e-12),
}
"""Numbers where something ends, by the words of their paths."""
CALCULATED = "([known, places]) => places.map((numbers) => transmission.calculate(known, numbers))"


def random_cases(chance: Random) -> Iterator[Transmission]:
    """Trains with freewheels, drag, friction back, converters and variators; not all can be."""
    while True:
        case = random_train(chance, regular=chance.random() < 0.6)
        elements = [_element(one, chance) for one in case.shift_elements]
        mechanisms = [_mechanism(one, n, chance) for n, one in enumerate(case.mechanisms, 1)]
        gears = [_gear(one, case, elements, chance) for one in case.gears]
        for one in mechanisms:
            if one.kind == "converter":  # with its lock-up clutch
                elements.append(ShiftElement(one.second, one.first, f"L{one.name}"))
                ends = {len(elements)} if chance.random() < 0.5 else set()
                gears = [each._replace(engaged=[*each.engaged, *ends]) for each in gears]
        try:
            yield case.replace(shift_elements=elements, mechanisms=mechanisms, gears=gears)
        except CaseError:
            continue


def _element(one: ShiftElement, chance: Random) -> ShiftElement:
    kind = chance.random()
    if kind < 0.3:
        return one._replace(kind="freewheel")
    return one._replace(drag=round(chance.uniform(0.001, 0.05), 3)) if kind < 0.4 else one


def _mechanism(one: Mechanism, number: int, chance: Random) -> Mechanism:
    one, kind = one._replace(name=f"P{number}"), chance.random()
    if kind < 0.1:
        return one._replace(back_efficiency=chance.choice((0.0, 0.3, 0.7, 1.0)))
    if kind > 0.2 or not (one.first and one.second):
        return one
    one = one._replace(third=0, planet_ratio=None)
    if kind < 0.16:
        points = ((0.0, 2.2), (0.5, 1.5), (0.9, 1.0))
        ratio = round(chance.random(), 2)
        return one._replace(kind="converter", ratio=ratio, efficiency=1.0, points=points)
    return one._replace(kind="variator", ratio=round(chance.uniform(-2, 2), 2))


def _gear(gear: Gear, case: Transmission, elements: list[ShiftElement], chance: Random) -> Gear:
    engaged = [one for one in gear.engaged if elements[one - 1].kind != "freewheel"]
    gear = gear._replace(engaged=engaged)
    if chance.random() < 0.15:
        drag = round(chance.uniform(0.001, 0.1), 3)
        gear = gear._replace(drag={chance.randint(1, case.links): drag})
    if chance.random() < 0.2:
        gear = gear._replace(coast=chance.random() < 0.5)
    if chance.random() < 0.2:
        gear = gear._replace(input_turns=chance.choice(("forward", "backward")))
    return gear


def edge(numbers: Mapping[str, float], chance: Random) -> dict[str, float]:
    """A place where up to three numbers are where something ends."""
    found = dict(numbers)
    for path in chance.sample(list(found), min(len(found), chance.randint(1, 3))):
        words = path.split(".")
        kind = words[2] if words[0] == "gears" else words[-1]
        if kind in EDGES:
            found[path] = chance.choice(EDGES[kind])
    return found


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(4))
def test_the_page_calculates_random_cases_as_the_program_does(browser: Any, seed: int) -> None:
    chance, room = seeded(seed), files("vstatics.report.live")
    window = browser.new_page()
    for name in ("core.js", "results.js"):
        window.add_script_tag(content=(room / name).read_text(encoding="utf-8"))
    agreed = 0
    for _, case in zip(range(count(20, 200)), random_cases(chance), strict=False):
        known = lowered(case)
        first, fields = known["numbers"], [*live_fields(case, known["numbers"])]
        near = [place(fields, chance) for _ in range(3)]
        places = [first, *near, *(edge(first, chance) for _ in range(4))]
        for numbers, gears in zip(
            places, window.evaluate(CALCULATED, [known, places]), strict=True
        ):
            expected = program(case, numbers, with_flow=True)
            for number, own in enumerate(gears):
                why = own.get("outside", "")
                if expected is None or expected[number]["fails"]:
                    assert why, (number, numbers)
                elif not why:
                    differ(known, number, own, expected[number], numbers)
                    agreed += 1
                else:
                    assert any(one in why for one in NOT_TRIED), (why, number, numbers)
    assert agreed > count(20, 200) * 5
    window.close()
