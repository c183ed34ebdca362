"""Pictures of a dumped clutch: bars and limits are the torques that `torsion dump` tells."""

import re
from pathlib import Path
from typing import Any, get_args

import pytest

from tests.commands import CASES, json_answer, vstatics
from tests.pictures import drawn as said
from tests.pictures.test_pictures import STYLES, overlaps
from tests.torsion.pictures.marks import drawn, marks, plotted
from vstatics import load, solve
from vstatics.pictures import picture
from vstatics.pictures.drawing.style import PAGE_HEIGHT, Style
from vstatics.torsion.pictures import dump

FILE = CASES / "moskvich412.yaml"


def answers() -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = json_answer("torsion", "dump", FILE)["gears"]
    return found


def test_bars_are_as_long_as_the_torques(tmp_path: Path) -> None:
    """All by one factor from the left edge, that of the largest torque."""
    gears = marks(plotted(tmp_path, FILE, "-k", "dump"), "dump")
    expected = answers()
    assert [one.data["gear"] for one in gears] == [one["name"] for one in expected]
    unit = 0.0
    for mark, told in zip(gears, expected, strict=True):
        paths = [
            [float(n) for n in re.sub("[MLz]", " ", one.attrib["d"]).split()]
            for one in mark.element.iter()
            if one.get("d", "").endswith("z")
        ]
        lengths = [max(one[::2]) - min(one[::2]) for one in paths if len(one) >= 8][:2]
        unit = unit or lengths[0] / told["max_torque"]
        torques = told["max_torque"], told["input_shaft_torque"]
        assert lengths == pytest.approx([unit * one for one in torques], abs=0.03)


def test_each_gear_tells_its_torque_and_case() -> None:
    texts = said.texts(picture(solve(load(FILE)), "dump", Style()))
    for one in answers():
        told = f"{one['max_torque']:.1f} N·m\n{one['case']}: "
        assert any(text.startswith(told) for text in texts)


def test_every_case_of_the_source_has_words() -> None:
    from vstatics.torsion.clutch.dumped import DumpCase

    assert set(dump._WORDS) == set(get_args(DumpCase))


@pytest.mark.slow
@pytest.mark.parametrize("style", STYLES)
def test_no_label_covers_another(style: Style) -> None:
    assert overlaps(solve(load(FILE)), "dump", style) == []


def test_pages_fit_their_paper() -> None:
    results = solve(load(FILE))
    style = Style(height=0.4 * PAGE_HEIGHT)
    pages = dump.draw(results, style)
    assert len(pages) == 2
    for figure in pages:
        wide, high = figure.size
        assert (wide <= style.width + 0.01, high <= style.height + 0.01) == (True, True)
    assert b'class="dump"' in drawn(results, "dump", Style(), 2)


def test_a_case_without_a_torque_of_a_dumped_clutch_says_so(tmp_path: Path) -> None:
    options = ("-k", "dump", "-o", tmp_path / "a.svg")
    text = FILE.read_text("utf-8")
    gears, dumped = text.index("gears:"), text.index("# the clutch of table 2.2")
    text = f"{text[:gears]}gears: {{N: [damper, dog 1, shaft 1]}}\n{text[dumped:]}"
    result = vstatics("plot", "-", *options, stdin=text.encode())
    told = "error: no torque of a clutch dump in gear N: engine of J1 does not rotate"
    assert result.fails(told)
