"""Shipped scenarios as examples of the package."""

from __future__ import annotations

from typing import get_args

import vstatics
from tests.commands import CASES
from vstatics.simulation import load_scenario
from vstatics.simulation.examples import ScenarioName


def test_a_checker_of_types_knows_the_names_of_scenarios() -> None:
    names = [name for name in vstatics.example() if name.startswith("scenarios/")]
    assert list(get_args(ScenarioName)) == names


def test_an_example_is_what_its_file_holds() -> None:
    assert vstatics.example("zf-8hp70") == vstatics.load(CASES / "zf-8hp70.yaml")
    scenario = vstatics.example("scenarios/tarasik-box")
    assert scenario == load_scenario(CASES / "scenarios/tarasik-box.yaml")
