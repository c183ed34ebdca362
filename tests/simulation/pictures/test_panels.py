"""Pictures of shipped runs, by the groups of their SVG, against the JSON of `vstatics simulate`."""

import re
from collections.abc import Mapping
from typing import Any, NamedTuple
from xml.etree import ElementTree as ET

import pytest

from tests.chance import with_slow
from tests.commands import CASES, vstatics
from vstatics import load_scenario, solve
from vstatics.pictures import pages
from vstatics.pictures.drawing.style import PAGE_HEIGHT, PAGE_WIDTH, Style
from vstatics.simulation import simulate
from vstatics.simulation.pictures.rows import WORD_HEIGHT

SVG = "{http://www.w3.org/2000/svg}"
QUICK = ("8l90-shifts", "gf4a-upshifts", "moskvich-start", "tarasik-box", "tarasik-set-lock")
ROADS = ("8", "gf4a", "tarasik-truck")
"""How names of scenarios with a road begin."""
FILES = sorted(path.stem for path in (CASES / "scenarios").glob("*.yaml"))
OTHERS = {*FILES} - {*QUICK, "moskvich-samples"}  # the samples are of moskvich-start
NAMES = with_slow(QUICK, sorted(OTHERS))


class Shown(NamedTuple):
    """A run as its picture and its JSON tell it."""

    name: str
    root: ET.Element
    run: Mapping[str, Any]

    def panels(self, kind: str) -> list[ET.Element]:
        """Groups of a kind of panel."""
        return self.root.findall(f".//{SVG}g[@class='panel'][@data-panel='{kind}']")

    def lines(self, kind: str) -> list[tuple[str, float]]:
        """Name and last value of each line."""
        groups = [g for panel in self.panels(kind) for g in panel.findall(f"{SVG}g[@class='line']")]
        return [(g.get("data-name", ""), float(g.get("data-last", "nan"))) for g in groups]

    def ends(self, *tables: str) -> list[tuple[str, float]]:
        """The last values of tables of the run."""
        return [
            (name, values[-1] if isinstance(values, list) else values)
            for table in tables
            for name, values in self.run[table].items()
        ]

    @property
    def texts(self) -> str:
        """All that is written."""
        return " ".join("".join(one.itertext()) for one in self.root.iter(f"{SVG}text"))


def parsed(svg: str | bytes) -> ET.Element:
    return ET.fromstring(svg)  # noqa: S314


@pytest.fixture(scope="module", params=NAMES)
def shown(request: pytest.FixtureRequest) -> Shown:
    name = request.param
    file = CASES / "scenarios" / f"{name}.yaml"
    out = ("--out", "vehicle_acceleration") if name.startswith(ROADS) else ()
    told = vstatics("simulate", file, "-f", "json", *out).json
    return Shown(name, parsed(vstatics("plot", file, "--kind", "shift", "-o", "-").out), told)


def near(one: list[tuple[str, float]], other: list[tuple[str, float]]) -> bool:
    """Whether names agree, and numbers as far as another step of output leaves them."""
    largest = max((abs(value) for _, value in other), default=0.0)
    pairs = dict(other)
    return all(
        name in pairs and value == pytest.approx(pairs[name], rel=1e-6, abs=1e-9 * largest)
        for name, value in one
    )


@pytest.mark.parametrize(
    ("kind", "table"), [("speed", "speeds"), ("slip", "slips"), ("torque", "torques")]
)
def test_lines_end_where_the_run_does(shown: Shown, kind: str, table: str) -> None:
    lines = shown.lines(kind)
    assert lines
    assert near(lines, shown.ends(table))
    if table == "speeds":  # every link that moves has a line
        largest = {name: max(map(abs, one)) for name, one in shown.run[table].items()}
        fastest = max(largest.values())
        assert {name for name, _ in lines} == {
            name for name, speed in largest.items() if speed > 1e-5 * fastest
        }


def test_heat_and_losses_have_a_line_or_are_left_out_by_name(shown: Shown) -> None:
    energies = [*shown.run["energy"]["heat"].items(), *shown.run["energy"]["losses"].items()]
    most = max(value for _, value in energies)
    large = [(name, value) for name, value in energies if value > 0.01 * most]
    lines = shown.lines("heat")
    assert sorted(name for name, _ in lines) == sorted(name for name, _ in large)
    assert sorted(value for _, value in lines) == pytest.approx(sorted(v for _, v in large))
    small = [name for name, value in energies if value <= 0.01 * most]
    notes = shown.texts.partition("left out: ")[2]
    assert bool(notes) == bool(small)
    assert [name for name in small if name not in notes] == []


def test_vehicle_or_output_is_a_panel_and_none_has_more_than_six_lines(shown: Shown) -> None:
    if "vehicle_acceleration" in shown.run:
        assert shown.panels("output") == []
        lines = shown.lines("acceleration")
        assert near(lines, shown.ends("vehicle_acceleration"))
    else:
        assert shown.panels("acceleration") == []
        lines = shown.lines("output")
    assert len(lines) == 1
    for panel in shown.root.iterfind(f".//{SVG}g[@class='panel']"):
        assert len(panel.findall(f"{SVG}g[@class='line']")) <= 6


def test_capacities_stand_behind_torques(shown: Shown) -> None:
    for panel in shown.panels("torque"):
        lines = {g.get("data-name"): g for g in panel.findall(f"{SVG}g[@class='line']")}
        for group in panel.findall(f"{SVG}g[@class='capacity']"):
            name, last = group.get("data-name", ""), float(group.get("data-last", "nan"))
            assert name in shown.run["slips"]
            carried = abs(float(lines[name].get("data-last", "nan")))
            assert carried <= last * (1 + 1e-9) + 1e-9
            assert colours(group) == colours(lines[name])
            assert "stroke-dasharray" in ET.tostring(group, encoding="unicode")


def colours(group: ET.Element) -> set[str]:
    found = set[str]()
    for one in group.iter():
        texts = (f"{key}: {one.get(key, '')}; {one.get('style', '')}" for key in ("stroke", "fill"))
        found.update(*(re.findall(r"(?:stroke|fill): (#\w+)", text) for text in texts))
    return found - {Style().paper}


def test_an_element_has_one_colour(shown: Shown) -> None:
    """Through bars, slip, torque, heat; and no other of up to seven has it."""
    found: dict[str, set[str]] = {}
    words = {Style().ink, Style().faint}  # of events, and the line at rest
    for kind in ("elements", "slip", "torque", "heat"):
        for panel in shown.panels(kind):
            for group in panel:
                name = group.get("data-name", "")
                if name in shown.run["slips"] and group.get("class") in ("element", "line"):
                    found.setdefault(name, set()).update(colours(group) - words)
    assert [name for name, seen in found.items() if len(seen) != 1] == []
    distinct = {next(iter(seen)) for seen in found.values()}
    assert len(distinct) == min(len(found), len(Style().colours))


def test_gears_of_a_shift_follow_each_other() -> None:
    """8l90-shifts.yaml asks for 2, 3, 2; tarasik-box.yaml engages FH F1, FB F1, FH F2: 1, 2, 3."""
    for name, expected in (("8l90-shifts", ["2", "3", "2"]), ("tarasik-box", ["1", "2", "3"])):
        file = CASES / "scenarios" / f"{name}.yaml"
        drawn = parsed(vstatics("plot", file, "--kind", "shift", "-o", "-").out)
        bar = drawn.iterfind(f".//{SVG}g[@data-gear]")
        assert [one.get("data-gear") for one in bar] == expected


def test_events_have_their_words_beside_their_rows(shown: Shown) -> None:
    """All of the shipped runs; together they take less than a fifth of the height."""
    said = [one.text or "" for one in shown.root.iter(f"{SVG}title")]
    for event in shown.run["events"]:
        word = event["word"] if "word" in event else f"step {event['step']}"
        assert any(one.startswith(f"{event['element']} {word}") for one in said), event
    rows = [g for panel in shown.panels("elements") for g in panel]
    with_words = [g for g in rows if len(list(g.iter(f"{SVG}text"))) > 1]  # beside its name
    assert WORD_HEIGHT * len(with_words) < 0.2 * float(shown.root.get("height", "").rstrip("pt"))
    assert bool(with_words) == bool(shown.run["events"])


def test_pages_are_no_larger_than_paper(shown: Shown) -> None:
    file = CASES / "scenarios" / f"{shown.name}.yaml"
    scenario = load_scenario(file)
    style = Style(height=PAGE_HEIGHT)
    made = pages(solve(scenario.case), "shift", "svg", style, motion=simulate(scenario))
    groups: list[str] = []
    for page in made:
        root = parsed(page)
        size = [float(root.get(side, "").removesuffix("pt")) for side in ("width", "height")]
        assert size[0] <= PAGE_WIDTH + 0.01
        assert size[1] <= PAGE_HEIGHT + 0.01
        groups += [g.get("data-panel", "") for g in root.iterfind(f".//{SVG}g[@class='panel']")]
    whole = [g.get("data-panel", "") for g in shown.root.iterfind(f".//{SVG}g[@class='panel']")]
    assert sorted(groups) == sorted(whole)
