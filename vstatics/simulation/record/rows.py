"""What the tables of a run have rows for, by name."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from typing import Literal

from vstatics.core.model.transmission import Transmission
from vstatics.simulation.record.converters import turbine
from vstatics.simulation.scenario.laws import Resistance, Road
from vstatics.simulation.scenario.parts import Scenario
from vstatics.simulation.scenario.words import vocabulary

Kind = Literal[
    "link",
    "shift element",
    "device",
    "friction",
    "loss",
    "link or spring",
    "element with a heat_capacity",
    "state",
    "link with a road",
    "converter",
    "step",
    "target",
    "device with fatigue",
    "number",
]
"""What has a row; a number has none. Friction is that of shift elements, of links with a resistance
or a road, of springs with a limit or friction; losses those of devices and of links with drag."""


def rows_of_kind(kind: Kind, scenario: Scenario) -> tuple[str, ...]:
    """The names of the rows of tables of a kind."""
    return tuple(_ROWS[kind](scenario))


def roads_of(scenario: Scenario) -> dict[int, Road]:
    """Number of each link with a road -> this."""
    return {link: law for link, law in scenario.torques if isinstance(law, Road)}


def friction_areas(case: Transmission) -> dict[str, float]:
    """Of all surfaces of each shift element that tells them [m^2]."""
    packs = ((one.name, one.pack) for one in case.shift_elements)
    return {name: pack.area * pack.surfaces for name, pack in packs if pack and pack.area}


def _links(scenario: Scenario) -> Sequence[str]:
    case = scenario.case
    return case.link_names[: case.own_links]


def _links_and_springs(scenario: Scenario) -> Iterable[str]:
    """A name is that of a link first, as in formulas."""
    return dict.fromkeys([*_links(scenario), *vocabulary(scenario.case).rows["twist"]])


def _named(scenario: Scenario, links: Iterable[int]) -> list[str]:
    """The names of links by their numbers."""
    return [scenario.case.link_names[link - 1] for link in links]


def _elements(scenario: Scenario) -> list[str]:
    return [element.name for element in scenario.case.shift_elements]


def _friction(scenario: Scenario) -> list[str]:
    loaded = {link for link, law in scenario.torques if isinstance(law, Resistance | Road)}
    springs = [
        one.name
        for number, one in enumerate(scenario.case.springs, 1)
        if one.limit is not None or one.friction or number in scenario.limits
    ]
    return [*_elements(scenario), *_named(scenario, sorted(loaded)), *springs]


def _devices(scenario: Scenario) -> list[str]:
    return [*scenario.case.devices, *(one.name for one in scenario.converters)]


def _converters(scenario: Scenario) -> list[str]:
    """Also mechanisms that are converters, which are open in motion."""
    moved = [one.name for one in scenario.case.mechanisms if one.kind == "converter"]
    return [*dict.fromkeys([*(one.name for one in scenario.converters), *moved])]


def _losses(scenario: Scenario) -> list[str]:
    dragged = {link for gear in scenario.case.gears for link in gear.drag}
    return [*_devices(scenario), *_named(scenario, sorted(dragged))]


def _steps(scenario: Scenario) -> list[str]:
    sequences = scenario.sequences
    return [f"{one.name},{number}" for one in sequences for number, _ in enumerate(one.steps, 1)]


def _targets(scenario: Scenario) -> list[str]:
    asked = scenario.targets.items()
    speeds = [(link, speed) for link, speeds in asked for speed in speeds]
    names = _named(scenario, (link for link, _ in speeds))
    return [f"{name} {speed:.12g}" for name, (_, speed) in zip(names, speeds, strict=True)]


def _of_formulas(word: str) -> Callable[[Scenario], Collection[str]]:
    """Of what formulas may speak with a word."""
    return lambda scenario: vocabulary(scenario.case).rows[word]


_ROWS: Mapping[Kind, Callable[[Scenario], Iterable[str]]] = {
    "link": _links,
    "shift element": _elements,
    "device": lambda scenario: [
        *_devices(scenario),
        *map(turbine, _converters(scenario)),
        *_named(scenario, scenario.speeds),
    ],
    "friction": _friction,
    "loss": _losses,
    "link or spring": _links_and_springs,
    "element with a heat_capacity": _of_formulas("temperature"),
    "state": lambda scenario: [state.name for state in scenario.states],
    "link with a road": lambda scenario: _named(scenario, roads_of(scenario)),
    "step": _steps,
    "target": _targets,
    "device with fatigue": lambda scenario: scenario.case.fatigue,
    "converter": _converters,
    "number": lambda _scenario: (),
}
