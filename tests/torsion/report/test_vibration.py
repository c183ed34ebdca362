"""The section of the report on vibration: the numbers of the modes, and when there is none."""

import importlib.util
from pathlib import Path

import pytest

from tests.commands import json_answer, vstatics
from tests.page.report.pages import Page, report, value, write

DRIVELINE = """\
name: little driveline
links: [engine, sun, ring, carrier, wheel]
load: {speed: 3000 rpm, torque: 100 N*m}
inertias: {engine: 0.15, ring: 0.02, carrier: 0.01, wheel: 10}
mechanisms: {set: {first: sun, second: ring, third: carrier, ratio: -78/30}}
shift_elements: {B: [ring, housing], C: [sun, ring], D: [engine, housing]}
springs:
  damper: {links: [engine, sun], stiffness: 1200, damping: 3}
  shaft: {links: [carrier, wheel], stiffness: 5000}
gears: {low: [B], direct: [C]}
"""


def without(package: str, monkeypatch: pytest.MonkeyPatch) -> None:
    found = importlib.util.find_spec
    monkeypatch.setattr(
        importlib.util,
        "find_spec",
        lambda name, parent=None: None if name == package else found(name, parent),
    )


@pytest.fixture(scope="module")
def shown(tmp_path_factory: pytest.TempPathFactory) -> Page:
    return Page(report(write(tmp_path_factory.mktemp("vibration"), DRIVELINE)))


@pytest.mark.slow
def test_frequencies_are_those_of_the_modes(shown: Page, tmp_path: Path) -> None:
    found = json_answer("torsion", "modes", write(tmp_path, DRIVELINE))["gears"]
    table = shown.table("Natural frequencies [Hz]")
    for gear in found:
        row = table[gear["name"]]
        assert value(row["rigid modes"]) == gear["rigid_modes"] == 1
        numbers = [value(row[str(n)]) for n, _ in enumerate(gear["modes"], 1)]
        assert numbers == [mode["frequency"] for mode in gear["modes"]]


def test_all_gears_have_one_campbell_diagram_and_each_its_modes(shown: Page) -> None:
    """The chosen gear has its modes, so all stand once by gear; rows of its tables are modes."""
    kinds = ("Campbell diagram", "Natural modes")
    captions = [one.text for one in shown.all("figcaption")]
    assert [one for one in captions if one in kinds] == [kinds[0], kinds[1], kinds[1]]
    labels = [one.attributes.get("aria-label") or "" for one in shown.all("svg")]
    assert [one for one in labels if one.startswith(kinds)] == [
        "Campbell diagram",
        *(f"Natural modes, gear {gear}" for gear in ("low", "direct")),
    ]
    for gear in ("low", "direct"):
        assert f"modes={gear}" in [one.attributes.get("id") for one in shown.all("div")]
    assert list(shown.table("Largest shares of energy")) == ["1", "2"]


@pytest.mark.slow
def test_a_gear_without_modes_says_why(tmp_path: Path) -> None:
    tied = DRIVELINE.replace("D: [", "W: [wheel, housing], D: [")
    tied = tied.replace("direct: [C]", "all: [B, C, D, W]")
    said = vstatics("report", write(tmp_path, tied), "-o", tmp_path / "out.html")
    assert said.status == 1
    page = Page((tmp_path / "out.html").read_text("utf-8"))
    assert page.table("Natural frequencies [Hz]")["all"]["note"].text.startswith("tied up: ")
    assert any(one.text.startswith("tied up: ") for one in page.all("p"))


@pytest.mark.slow
@pytest.mark.usefixtures("without_pictures")
def test_only_what_vibrates_has_the_section(tmp_path: Path) -> None:
    springs = DRIVELINE[DRIVELINE.index("springs:") : DRIVELINE.index("gears:")]
    rigid = DRIVELINE.replace(springs, "").replace(", D: [engine, housing]", "")
    rigid = rigid.replace("[engine, sun, ring, carrier, wheel]", "[sun, ring, carrier]")
    rigid = rigid.replace("engine: 0.15, ", "").replace(", wheel: 10", "")
    inertias = "inertias: {engine: 0.15, ring: 0.02, carrier: 0.01, wheel: 10}\n"
    for text, vibrates in (
        (DRIVELINE, True), (DRIVELINE.replace(inertias, ""), False), (rigid, False),
    ):  # fmt: skip
        titles = [one.text for one in Page(report(write(tmp_path, text))).all("h2")]
        assert ("Vibration" in titles) == vibrates


@pytest.mark.slow
def test_without_scipy_the_rest_is_written(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    without("scipy", monkeypatch)
    pip = 'pip install ".[torsion]" in the source folder, or pip install scipy'
    needs = f"the section on vibration needs the package scipy: {pip}"
    said = vstatics("report", write(tmp_path, DRIVELINE), "-o", "-")
    assert said.status == 0
    assert f"no vibration: {needs}" in said.err
    page = Page(said.out)
    assert f"Left out: {needs} [E014]" in [one.text for one in page.all("p")]
    assert page.table("Ratios, steps")["low"]["ratio"].text == "3.600"
    assert vstatics("report", write(tmp_path, DRIVELINE), "-o", "-", "-q").err == ""


def test_without_matplotlib_there_are_the_tables(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    without("matplotlib", monkeypatch)
    page = Page(vstatics("report", write(tmp_path, DRIVELINE), "-o", "-").out)
    assert set(page.table("Natural frequencies [Hz]")) == {"low", "direct"}
    assert not page.all("svg")
