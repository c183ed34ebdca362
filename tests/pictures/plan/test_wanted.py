"""The plan of wanted ratios alone: rays by the rule of the paper on the UMDM, figure 5."""

import re
from pathlib import Path

import pytest

from tests.commands import CASES, vstatics
from tests.installed import needs
from vstatics import solve
from vstatics.pictures.plan.rays import plans
from vstatics.pictures.plan.wanted import case_of_ratios


def test_a_link_that_stands_in_a_gear_has_its_ray() -> None:
    """Y = (u x - 1)/(u - 1): zero at x = 1/u, and 1 at x = 1; the input 1, the output x."""
    ratios = [37 / 14, 111 / 65, 1, 0.7, -37 / 9]
    case = case_of_ratios(ratios)
    [plan] = plans(solve(case))
    assert [mark.output for mark in plan.marks] == pytest.approx([1 / u for u in ratios])
    assert plan.has_unit_point
    rays = {case.link_names[ray.links[0] - 1]: ray for ray in plan.rays}
    assert len(rays) == 6
    assert [*rays["input"][1:]] == pytest.approx([1, 0], abs=1e-12)
    assert [*rays["output"][1:]] == pytest.approx([0, 1], abs=1e-12)
    for u in ratios:
        if u != 1:
            ray = rays[f"{u:.12g}"]
            assert ray.start == pytest.approx(-1 / (u - 1))
            assert ray.slope == pytest.approx(u / (u - 1))


def test_it_needs_no_case(tmp_path: Path) -> None:
    file = tmp_path / "plan.svg"
    asked = ("plot", "--kind", "plan", "-o", file, "--ratios")
    said = vstatics(*asked, "2.6,1.7,-4")
    assert said.is_silent()
    assert "Ratios 2.6, 1.7, -4" in file.read_text("utf-8")
    assert vstatics(*asked, "2.6,-4", "--lang", "ru").status == 0
    russian = file.read_text("utf-8")
    assert "Передаточные отношения 2.6, -4" in russian
    assert not {"input", "output"} & {*re.findall(r">(\w+)<", russian)}


def test_what_is_no_plan() -> None:
    umdm, of_a_case = CASES / "umdm.yaml", "--from, --coast, --unloaded: only a case has them"
    for options, why in {
        "-k plan --ratios 2,0": "read 0, expected a ratio from 1e-6 to 1e6 in size",
        "-k plan --ratios 2,-inf": "read -inf, expected a ratio from 1e-6 to 1e6 in size",
        "-k plan --ratios 2,3,2": "read 2 again, expected each ratio once",
        "-k plan --ratios 2,x": "read 'x', expected ratios of gears such as 2.6,1.7,-4",
        f"{umdm} -k plan --ratios 2": "--ratios: expected no case",
        "-k lever --ratios 2": "--ratios: only a plan follows from ratios alone",
        "-k lever": "Missing argument 'CASE...'.",
        "-k plan --ratios 2 --coast": of_a_case,
        "s.csv -k curves --unloaded exact": of_a_case,
    }.items():
        assert vstatics("plot", *options.split(), "-o", "plan.svg").is_wrong_use(why), options


@needs("vehicle")
def test_a_vehicle_is_drawn_at_full_load() -> None:
    said = vstatics("plot", CASES / "umdm.yaml", "-k", "sawtooth", "--drive", "-o", "plan.svg")
    assert said.is_wrong_use("--coast: a vehicle is drawn at full")
