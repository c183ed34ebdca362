"""Shipped scenarios."""

from __future__ import annotations

import vstatics
from tests.commands import CASES
from vstatics.simulation import load_scenario


def test_an_example_is_what_its_file_holds() -> None:
    assert vstatics.example("zf-8hp70") == vstatics.load(CASES / "zf-8hp70.yaml")
    scenario = vstatics.example("scenarios/tarasik-box")
    assert scenario == load_scenario(CASES / "scenarios/tarasik-box.yaml")
