"""SVG of pictures: texts that can be found and copied, titles, nothing that could run."""

import re
from typing import Any
from xml.etree import ElementTree as ET

import pytest

from tests.commands import CASES
from tests.pictures.test_pictures import in_van
from tests.shipped import shipped_results
from vstatics import load, solve
from vstatics.pictures import drawn_kinds, render
from vstatics.pictures.drawing.figures import figure_of
from vstatics.pictures.drawing.pen import blank
from vstatics.pictures.drawing.style import Style
from vstatics.pictures.drawing.svg import written_as_svg

SVG = "{http://www.w3.org/2000/svg}"
STYLE = Style()
SET = solve(in_van(load(CASES / "ravigneaux-gf4a.yaml")))
SPRINGS = shipped_results("moskvich412.yaml")
KINDS = [kind for kind in drawn_kinds() if kind not in ("shift", "spectrum")]
OF_VIBRATION = [kind for kind, own in drawn_kinds().items() if own.shows == "vibration"]


def parsed(svg: bytes) -> ET.Element:
    return ET.fromstring(svg)  # noqa: S314 - from nowhere else


def made(**how: Any) -> ET.Element:
    pen = blank(144.0, 72.0, STYLE)
    pen.text(72.0, 36.0, "sun <1>\nК & −2.5", **how)
    return parsed(written_as_svg(pen.canvas, "a <set>"))


def test_texts_stay_texts_in_letters_that_other_machines_have() -> None:
    root = made(title='P1: "sun" & <ring>', over=True)
    assert [text.text for text in root.iter(f"{SVG}text")] == ["sun <1>", "К & −2.5"]
    assert "sans-serif" in root.attrib["font-family"]
    assert root.findtext(f"{SVG}title") == "a <set>"
    group = next(root.iter(f"{SVG}g"))
    assert group.findtext(f"{SVG}title") == 'P1: "sun" & <ring>'
    assert (group.attrib["paint-order"], group.attrib["stroke"]) == ("stroke", STYLE.paper)
    pen = blank(72.0, 72.0, STYLE)  # for dots
    pen.text(36.0, 36.0, "x", over=True)
    assert figure_of(pen.canvas).texts[0].get_path_effects()


def test_parts_with_one_tooltip_are_one_group() -> None:
    pen = blank(50.0, 50.0, STYLE)
    for place, name in enumerate(("sun", "sun", "ring")):
        pen.line((0.0, place), (5.0, place), title=name, kind="wire", color="#000000")
    groups = parsed(written_as_svg(pen.canvas, "")).iter(f"{SVG}g")
    assert [(group.findtext(f"{SVG}title"), len(group)) for group in groups] == [
        ("sun", 3),
        ("ring", 2),
    ]


def test_spaces_between_parts_of_a_text_stay() -> None:
    pen = blank(144.0, 72.0, STYLE)
    pen.text(72.0, 36.0, "mode 1    6.5 Hz")
    svg = written_as_svg(pen.canvas, "")
    assert b'xml:space="preserve">mode 1    6.5 Hz' in svg
    assert next(parsed(svg).iter(f"{SVG}text")).text == "mode 1    6.5 Hz"


@pytest.mark.parametrize("dark", [False, True])
@pytest.mark.parametrize("kind", KINDS)
def test_texts_of_every_kind_have_contrast_and_typeset_numbers(kind: str, dark: bool) -> None:
    style = Style(dark=dark)
    results = SPRINGS if kind in OF_VIBRATION else SET
    gears = (2,) if kind in OF_VIBRATION else ()
    root = parsed(render(results, kind, "svg", style, gears))
    readable = {style.ink, style.soft, style.engaged, style.lost, style.circulating}
    texts = [*root.iter(f"{SVG}text")]
    assert texts
    assert {text.attrib.get("fill", "#000000") for text in texts} <= readable | {style.paper}
    assert len(root.findall(f".//{SVG}title")) > 4
    for said in ("".join(text.itertext()) for text in texts):
        assert not re.search(r"(?<![\w.)])-\.?\d|(?<![\w.])\.\d", said), said


def test_what_belongs_together_is_one_group() -> None:
    pen = blank(50.0, 50.0, Style())
    for turn in range(2):
        for name in ("sun", "ring"):
            link = pen.within("scheme").within("link", name=name)
            link.line((0.0, turn), (5.0, turn), kind="wire", color="#000000")
    root = parsed(written_as_svg(pen.canvas, ""))
    [scheme] = root.findall(".//*[@class='scheme']")
    found = {link.get("data-name"): [part.get("class") for part in link] for link in scheme}
    assert found == {"sun": ["wire", "wire"], "ring": ["wire", "wire"]}
