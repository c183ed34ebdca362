"""Pictures of load duration distributions: bars have the numbers of the summary."""

from __future__ import annotations

import math
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from tests.commands import json_answer, vstatics
from vstatics import load, plot, solve

CASE = """\
links: [in, out]
mechanisms: {pair: {first: in, second: out, ratio: -2, efficiency: 0.98}}
gears: {"1": []}
"""
DUTY = """\
time [s],gear,speed [rpm],torque [N*m]
60,1,600,10
60,1,6000,100
30,1,60,-40
50,,0,0
"""


@pytest.fixture(autouse=True)
def _files(folder: Path) -> None:
    (folder / "case.yaml").write_text(CASE)
    (folder / "duty.csv").write_text(DUTY)


def bars(*options: str) -> dict[str, list[ET.Element]]:
    """Draw the spectrum, and return the bars of each member."""
    asked = ("plot", "case.yaml", "-k", "spectrum", "--duty", "duty.csv", *options)
    assert vstatics(*asked, "-o", "s.svg").status == 0
    panels = [e for e in ET.parse("s.svg").iter() if e.get("class") == "panel"]  # noqa: S314 - own file
    return {
        p.get("data-name", ""): [b for b in p.iter() if b.get("class") == "class"] for p in panels
    }


@pytest.mark.parametrize("classes", ["4", "20,50 N*m"])
def test_each_bar_is_a_class_of_the_summary(classes: str) -> None:
    asked = ("summary", "case.yaml", "--duty", "duty.csv", "--spectrum", classes, "-f", "json")
    members = json_answer(*asked)["duty"]["spectrum"]
    drawn = bars("--spectrum", classes)
    assert set(drawn) == set(members)
    for name, elements in drawn.items():
        filled = [each for each in members[name]["classes"] if each["revolutions"]]
        for bar, each in zip(elements, filled, strict=True):
            for key in ("from", "to", "revolutions", "contacts", "time", "speed"):
                number = float(bar.get(f"data-{key}") or "nan")
                expected = math.nan if each[key] is None else each[key]
                assert number == pytest.approx(expected, rel=1e-8, nan_ok=True)


def test_a_bar_is_as_high_as_its_revolutions() -> None:
    """From 600 to 6,000 turns is a decade; from 30 to 600 turns are log10(20) decades."""
    heights = {}
    for bar in bars()["pair.first"]:
        [path] = [p for p in bar.iter() if p.tag.endswith("path")]
        words = path.get("d", "").replace("M", " ").replace("L", " ").replace("z", "").split()
        ys = [float(word) for word in words[1::2]]
        heights[round(float(bar.get("data-revolutions", "")))] = max(ys) - min(ys)
    assert set(heights) == {600, 6000, 30}
    decade = heights[6000] - heights[600]
    assert heights[600] - heights[30] == pytest.approx(decade * math.log10(20), abs=0.03)


def test_wrong_files_and_classes_are_located(folder: Path) -> None:
    (folder / "bad.csv").write_text(DUTY.replace("60,1,6000", "60,9,6000"))
    (folder / "still.csv").write_text(
        DUTY.replace("100", "0").replace(",10\n", ",0\n").replace("-40", "0")
    )
    asked = ("plot", "case.yaml", "-k", "spectrum", "-o", "no.svg")
    assert vstatics(*asked).is_wrong_use("expected a duty cycle as a CSV of points")
    assert vstatics(*asked, "--duty", "case.yaml").is_wrong_use("a CSV of points")
    assert vstatics(*asked, "--duty", "duty.csv", "--spectrum", "0").is_wrong_use("from 1 to 1000")
    assert vstatics(*asked, "--duty", "bad.csv").fails("bad.csv:3:1: error: there is no gear `9`")
    assert vstatics(*asked, "--duty", "still.csv").fails("no member turns under torque")
    assert vstatics(*asked, "--duty", "duty.csv", "--gear", "1").is_wrong_use("its own gears")
    assert not (folder / "no.svg").exists()


def test_python_draws_the_same_picture() -> None:
    bars("--spectrum", "20,50 N*m")
    picture = plot(solve(load("case.yaml")), "spectrum", duty="duty.csv", classes=[20, 50])
    picture.save("python.svg")
    assert Path("python.svg").read_bytes() == Path("s.svg").read_bytes()
    with pytest.raises(ValueError, match="a CSV of points"):
        plot(solve(load("case.yaml")), "spectrum")
