"""Random trains with drag of every form in every place, as files; and the power that it takes.

Speeds are from fractions (`tests.oracle`), the drag torque at each speed from a function beside the
text of its law, so the expected power ``sum(c(w) w)`` shares nothing with the program.
"""

import math
from collections.abc import Callable, Mapping
from pathlib import Path
from random import Random
from typing import Any, NamedTuple

import yaml

from tests.oracle.systems import Speeds
from tests.trains import is_regular, random_train
from vstatics import Transmission, load
from vstatics.core.writers.named import mapping

Torque = Callable[[float, float], float]
"""The torque of a drag [N*m] at a speed [rad/s] and a torque at the input [N*m]."""
LAWS = (
    {"over": "speed", "points": [[0, 0.9], [300, 0.97]]},
    {"over": "torque", "points": [[0, 0.85], [500, 0.98]]},
)
"""Efficiencies that depend."""


class GivenDrag(NamedTuple):
    """A drag as a case has it, and the torque that it stands for."""

    written: Any
    at: Torque


class DraggedCase(NamedTuple):
    """A random case with drag in all places, and the power of drag in each gear."""

    file: Path
    case: Transmission
    lost_kw: Mapping[str, float]
    """Only of gears whose speeds have one solution."""


def random_drag(chance: Random, folder: Path) -> GivenDrag:
    """A drag of one of the forms that a case may have; many are 0 at rest."""
    a, b = round(chance.uniform(0.1, 3), 2), round(chance.uniform(1e-3, 3e-2), 4)

    def straight(speed: float, _: float) -> float:
        return a * min(speed, 200) / 200

    part, name = round(a / 100, 4), f"drag{len([*folder.iterdir()])}.csv"
    (folder / name).write_text(f"speed [rad/s],torque [N*m]\n0,0\n200,{a}\n", "utf-8")
    forms: tuple[tuple[Any, Torque], ...] = (
        (f"{a} N*m", lambda *_: a),
        (part, lambda _, torque: part * torque),
        (f"{b}*w", lambda speed, _: b * speed),
        (f"{b}*w**2/100", lambda speed, _: b * speed**2 / 100),
        (f"{a} + {b}*w", lambda speed, _: a + b * speed),
        ([[0, 0], ["200 rad/s", f"{a} N*m"]], straight),
        ({"file": name}, straight),
    )
    return GivenDrag(*chance.choice(forms))


def random_case(chance: Random, folder: Path) -> DraggedCase:
    """A random train with drag of the case, of gears, and of open shift elements."""
    size, speed = chance.choice((2.0, 20.0, 400.0)), chance.choice((30.0, 150.0, -400.0))
    several = chance.random() < 0.5
    train = random_train(chance, regular=not several)
    named = [gear._replace(name=f"gear{n}") for n, gear in enumerate(train.gears, 1)]
    train = train.replace(gears=named)
    data = mapping(train)
    data["load"] = {"speed": f"{speed} rad/s", "torque": f"{math.copysign(size, speed)} N*m"}

    def drags(numbers: range, chances: float) -> dict[int, GivenDrag]:
        chosen = [number for number in numbers if chance.random() < chances]
        return {number: random_drag(chance, folder) for number in chosen}

    links, numbers = range(1, train.links + 1), range(1, len(train.shift_elements) + 1)
    of_links, of_elements = drags(links, 0.4), drags(numbers, 0.4)
    data["drag"] = {link: one.written for link, one in of_links.items()}
    for number, one in of_elements.items():
        element = train.shift_elements[number - 1]
        data["shift_elements"][element.name] = {"links": [*map(_link, element.links)]} | {
            "drag": one.written
        }
    for mechanism in data["mechanisms"].values():
        if chance.random() < 0.1:
            mechanism["efficiency"] = LAWS[chance.random() < 0.2]  # that over torque takes long
    lost = {}
    for gear in train.gears:
        own = drags(links, 0.15), drags(numbers, 0.15)
        names = [element.name for element in train.shift_elements]
        given = data["gears"][gear.name]
        given["drag"] = {link: one.written for link, one in own[0].items()}
        given["open_drag"] = {names[number - 1]: one.written for number, one in own[1].items()}
        torque = size
        if chance.random() < 0.3:
            torque = chance.choice((5.0, 90.0))
            given["load"] = {"torque": f"{math.copysign(torque, speed)} N*m"}
        if is_regular(train, gear):
            moves = Speeds(train, gear)
            by_part = (
                *(((link, 0), one) for link, one in (of_links | own[0]).items()),
                *(
                    (train.shift_elements[number - 1].links, one)
                    for number, one in (of_elements | own[1]).items()
                    if number not in gear.engaged
                ),
            )
            slips = (
                (abs(float(moves.difference(*ends) or 0) * speed), one) for ends, one in by_part
            )
            lost[gear.name] = math.fsum(one.at(slip, torque) * slip for slip, one in slips) / 1000
    file = folder / "case.yaml"
    file.write_text(yaml.safe_dump(data), "utf-8")
    return DraggedCase(file, load(file), lost)


def _link(number: int) -> int | str:
    return number or "housing"
