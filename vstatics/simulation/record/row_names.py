"""Names of the rows of the tables of a run."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
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
"""Kinds of rows; a table of kind `number` has a single row without a name.

`friction`: shift elements, links with a resistance or a road, and springs with a limit or friction.
`loss`: components, and links with drag.
"""


def rows_of_kind(kind: Kind, scenario: Scenario) -> tuple[str, ...]:
    """Return the names of the rows of a kind."""
    return tuple(_ROWS[kind](scenario))


def roads_of(scenario: Scenario) -> dict[int, Road]:
    """Return the roads of a scenario by link number."""
    return {link: law for link, law in scenario.torques if isinstance(law, Road)}


def friction_areas(case: Transmission) -> dict[str, float]:
    """Return the total friction area of each shift element with a known area, by name [m^2]."""
    packs = ((element.name, element.pack) for element in case.shift_elements)
    return {name: pack.area * pack.surfaces for name, pack in packs if pack and pack.area}


def _links(scenario: Scenario) -> Sequence[str]:
    case = scenario.case
    return case.link_names[: case.own_links]


def _links_and_springs(scenario: Scenario) -> Iterable[str]:
    """Return the names of links and springs; a name of both denotes the link, as in formulas."""
    return dict.fromkeys([*_links(scenario), *vocabulary(scenario.case).rows["twist"]])


def _named(scenario: Scenario, links: Iterable[int]) -> list[str]:
    return [scenario.case.link_names[link - 1] for link in links]


def _elements(scenario: Scenario) -> list[str]:
    return [element.name for element in scenario.case.shift_elements]


def _friction(scenario: Scenario) -> list[str]:
    loaded = {link for link, law in scenario.torques if isinstance(law, Resistance | Road)}
    springs = [
        spring.name
        for number, spring in enumerate(scenario.case.springs, 1)
        if spring.limit is not None or spring.friction or number in scenario.limits
    ]
    return [*_elements(scenario), *_named(scenario, sorted(loaded)), *springs]


def _devices(scenario: Scenario) -> list[str]:
    return [*scenario.case.devices, *(converter.name for converter in scenario.converters)]


def _converters(scenario: Scenario) -> list[str]:
    names = [converter.name for converter in scenario.converters]
    names += [part.name for part in scenario.case.mechanisms if part.kind == "converter"]
    return [*dict.fromkeys(names)]


def _losses(scenario: Scenario) -> list[str]:
    dragged = {link for gear in scenario.case.gears for link in gear.drag}
    return [*_devices(scenario), *_named(scenario, sorted(dragged))]


def _steps(scenario: Scenario) -> list[str]:
    return [
        f"{sequence.name},{number}"
        for sequence in scenario.sequences
        for number, _ in enumerate(sequence.steps, 1)
    ]


def _targets(scenario: Scenario) -> list[str]:
    names = scenario.case.link_names
    return [
        f"{names[link - 1]} {speed:.12g}"
        for link, speeds in scenario.targets.items()
        for speed in speeds
    ]


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
    "element with a heat_capacity": lambda scenario: vocabulary(scenario.case).rows["temperature"],
    "state": lambda scenario: [state.name for state in scenario.states],
    "link with a road": lambda scenario: _named(scenario, roads_of(scenario)),
    "step": _steps,
    "target": _targets,
    "device with fatigue": lambda scenario: [
        name for name, given in scenario.case.fatigue.items() if hasattr(given, "endurance")
    ],
    "converter": _converters,
    "number": lambda _scenario: (),
}
