"""Scenarios of the tests as people write them."""

from typing import Any

import pytest

from vstatics import ReadError
from vstatics.core import readers
from vstatics.simulation import Motion, Scenario, simulate
from vstatics.simulation.scenario.file import read_scenario

TWO_WHEELS = """inertias: {e: 2, o: 3}
shift_elements: {C: {links: [e, o]}}
gears: {g: [C]}
"""
"""An engine, an output, and a clutch between."""
DOG = TWO_WHEELS.replace("C", "D").replace("{links: [e, o]}", "{links: [e, o], kind: dog_clutch}")
"""The same with a dog clutch."""


def written(scenario: str, case: str = TWO_WHEELS) -> Scenario:
    """A scenario of its keys but `case`."""
    document = read_scenario(f"case: box.yaml\n{scenario}".encode(), "scenario.yaml")
    return document.with_case(readers.read(case.encode(), "box.yaml")).scenario


def simulated(scenario: str, case: str = TWO_WHEELS) -> Motion:
    motion = simulate(written(scenario, case))
    assert motion.stopped is None, motion.stopped
    return motion


def steps_of(motion: Motion) -> list[tuple[int | None, Any]]:
    """Numbers of steps of sequences that were done, and when."""
    return [(one.step, one.time) for one in motion.events if one.event == "step"]


def faults(scenario: str, case: str = TWO_WHEELS) -> list[str]:
    """Line, column and words of what is wrong with a scenario; its own keys begin on line 2."""
    with pytest.raises(ReadError) as caught:
        written(scenario, case)
    located = [(one.place, one.message) for one in caught.value.problems if one.place]
    return [f"{place.line}:{place.column} {message}" for place, message in located]
