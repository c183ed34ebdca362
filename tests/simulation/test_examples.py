"""Names of shipped scenarios."""

from __future__ import annotations

from typing import get_args

import vstatics
from vstatics.simulation.examples import ScenarioName


def test_a_checker_of_types_knows_the_names_of_scenarios() -> None:
    names = [name for name in vstatics.example() if name.startswith("scenarios/")]
    assert list(get_args(ScenarioName)) == names
