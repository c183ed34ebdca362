"""Converters of a scenario and of its case."""

from __future__ import annotations

from tests.core.readers.named.test_converters import CASE
from vstatics.core.model.converters import Converter
from vstatics.core.readers.named.reader import read_yaml
from vstatics.simulation.scenario.file import read_scenario


def test_a_scenario_without_converters_has_those_of_the_case() -> None:
    reading = read_yaml(CASE.encode(), "case.yaml")
    scenario = b"{case: case.yaml, duration: 1, start: {speeds: {engine: 1, turbine: 1}}%s}"
    own = b", converters: {C2: {links: [engine, out], points: [[0, 1, 1]]}}"
    without, other = (
        read_scenario(scenario % more, "s.yaml").with_case(reading).scenario.converters
        for more in (b"", own)
    )
    assert without == reading.case.converters
    assert other == (Converter("C2", 1, 3, ((0.0, 1.0, 1.0),)),)
