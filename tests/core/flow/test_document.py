"""The power flow as JSON."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.commands import NEUTRAL, json_answer


def test_json_has_the_numbers_of_the_library(tmp_path: Path) -> None:
    file = tmp_path / "case.yaml"
    file.write_text(NEUTRAL, encoding="utf-8")
    [neutral, low] = json_answer("flow", file)["gears"]
    assert (neutral["ideal"], neutral["note"]) == (None, "torques do not balance")
    # the differential has -2.5 and .96, its second link is held: the third gives .9714
    assert low["lossy"]["leaving"] == pytest.approx(3.4 / 3.5)
    assert low["lossy"]["losses"] == [
        {
            "kind": "mechanism",
            "number": 1,
            "name": "D",
            "power": pytest.approx(0.1 / 3.5),
            "share": 1,
        }
    ]
    assert low["input_link_kW"] is None
