"""Panels of a plan for the states of a run."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.commands import CASES, json_answer, vstatics
from tests.pictures.drawn import texts
from tests.pictures.plan.test_gears import DCT, panels, told_panels
from vstatics import load, loads, solve
from vstatics.pictures import picture
from vstatics.pictures.drawing.style import Style
from vstatics.simulation import Motion
from vstatics.simulation.record.motion import Energy


def pages_of(picture: Path) -> list[bytes]:
    further = picture.parent.glob(f"{picture.stem}-*.svg")
    ordered = sorted(further, key=lambda one: (len(one.name), one.name))
    return [one.read_bytes() for one in (picture, *ordered)]


@pytest.mark.slow
@pytest.mark.parametrize("name", ["gf4a-upshifts.yaml", "8hp70-upshift.yaml", "tarasik-box.yaml"])
def test_a_run_has_the_panels_whose_elements_stick_for_a_while(name: str, tmp_path: Path) -> None:
    """An element sticks from one instant to the next where it has no slip at both."""
    scenario = CASES / "scenarios" / name
    said = json_answer("simulate", scenario)
    turns = np.array(list(said["speeds"].values()))
    last = np.diff(said["time"]) > 0

    def sticks(element: str) -> Any:
        still = np.abs(said["slips"][element]) < 1e-6 * np.abs(turns).max()
        return still[1:] & still[:-1] & last

    case = scenario.parent / scenario.read_text().split("case: ")[1].split()[0]
    found, _ = panels(solve(load(case)))
    gone_through = [
        engaged
        for _, engaged in found
        if np.all([np.any([*map(sticks, one.split("/"))], axis=0) for one in engaged], axis=0).any()
    ]
    assert 0 < len(gone_through) <= len(found)
    picture = tmp_path / "run.svg"
    assert vstatics("plot", scenario, "-k", "plan", "-o", picture).status == 0
    assert [engaged for _, engaged in told_panels(pages_of(picture))[0]] == gone_through


def test_a_run_on_no_plan_says_so() -> None:
    """All links have different speeds all the time, so neither clutch of the DCT sticks."""
    case = loads(DCT)
    speeds = np.tile(np.arange(1.0, 1 + case.own_links), (3, 1))
    names = tuple(map(case.link_name, range(1, 1 + case.own_links)))
    none = np.zeros((3, 0))
    energy = Energy(0.0, {}, {}, {}, 0.0, 0.0, 0.0, 0.0)
    motion = Motion(np.arange(3.0), names, (), (), speeds, none, none, none, (), energy, {})
    drawn = picture(solve(case), "plan", Style(), motion=motion)
    assert "the run is on no plan" in texts(drawn)
