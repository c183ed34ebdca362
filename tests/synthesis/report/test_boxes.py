"""The page of found boxes."""

import json
import math
import re
from typing import Any

import pytest

from tests.core.texts.test_pages import SYMBOLS, left, names, words_of
from tests.installed import needs
from tests.synthesis.boxes.listed_boxes import many, simpson, zf_6hp
from vstatics import CaseError
from vstatics.core.texts import speaking
from vstatics.synthesis.boxes.box import BoxSearch, WantedSequence
from vstatics.synthesis.boxes.listing import wanted_of
from vstatics.synthesis.boxes.reading import listing_of
from vstatics.synthesis.report import boxes
from vstatics.synthesis.report.boxes import box_pages, boxes_page

pytestmark = needs("page")


def page(document: dict[str, Any], digits: int | None = None) -> str:
    return boxes_page(listing_of(document), document, digits)


def rows(html: str, section: str, table: int = 1) -> list[str]:
    body = html.partition(f'<section id="{section}">')[2].split("<tbody>")[table]
    return re.findall("<tr.*?</tr>", body.partition("</tbody>")[0])


def words(html: str) -> str:
    return " ".join(re.sub("<[^>]+>", " ", html).split())


def test_the_page_has_all_boxes_families_gears_and_diagrams() -> None:
    html = page(simpson())
    sections = re.findall(r'<section id="([\w-]+)"', html)
    assert sections == ["overview", "boxes", "diagrams"]
    assert "<h1>1 found box</h1>" in html
    counts = "given up 0 families, of equal ratios 1 in the Pareto list 1 least"
    assert f"looked at 27885 choices of shift elements {counts}" in words(html)
    assert html.count('href="#box-1"') == 3  # best in both, and in the table
    assert len(rows(html, "boxes")) == len(rows(html, "boxes", 2)) == 1
    assert len(rows(html, "diagrams")) == 4  # gears
    assert html.count("<svg") == 2
    assert 'id="box-1"' in html
    found = re.search('<script type="application/json" id="result">(.*?)</script>', html)
    assert found is not None
    assert json.loads(found[1]) == simpson()
    with pytest.raises(CaseError, match="no gearbox was found"):
        page({"searched": 3, "boxes": []})


@pytest.mark.slow
def test_names_are_text() -> None:
    html = page(json.loads(json.dumps(simpson()).replace("T-L0", "<b onload=x>")))
    assert "<b onload" not in html
    assert "&lt;b onload=x&gt;" in html


FALLING = WantedSequence(6, 8, (5, 7), (1.2, 1.8), falling=True)
ANY_SPREAD = WantedSequence(3, 3, (1, 1e6), (1.2, 1.8))
RANGES = (0.01, math.log(2), 0.01)


def test_the_page_tells_what_was_wanted_and_not_what_the_first_box_has() -> None:
    listing = listing_of(simpson())
    falling = "no step larger than the one below it; further ratios: −3."
    for search, said in (
        (BoxSearch(2, 4, 2, (1.0, 3.0, -2.0), tolerances=RANGES), "1: 1.5 to 6, 2: 1, R: −2."),
        (
            BoxSearch(3, 5, 2, (-3.0,), sequence=FALLING),
            f"forward gears: 6 to 8; spread 5 to 7; steps 1.2 to 1.8; {falling}",
        ),
        (BoxSearch(2, 3, 1, (), sequence=ANY_SPREAD), "forward gears: 3; steps 1.2 to 1.8."),
    ):
        page = boxes_page(listing._replace(wanted=wanted_of(search)))
        assert f"Wanted: {said}" in words(page)
    assert "Wanted" not in words(boxes_page(listing._replace(wanted=None)))


def test_a_gear_within_its_range_is_not_off() -> None:
    document = simpson()
    first, last = document["wanted"]["ratios"][0], document["boxes"][0]["gears"]["1"]
    low, high = last["target"] / 1.2, last["target"] * 1.2
    document["wanted"]["ratios"][0] = [low, high]
    assert first[0] < last["target"] < first[1]
    own = [words(row) for row in rows(page(document), "diagrams")]
    assert own[0].endswith(f"{last['ratio']:.3f} {low:g} to {high:g}")
    assert [len(row.split()) - row.count("●") for row in own[1:]] == [4, 4, 4]  # target, off


@pytest.mark.parametrize("document", [many(5), zf_6hp()])
def test_a_page_has_no_english_words(document: dict[str, Any]) -> None:
    with speaking("ru"):
        html = page(document)
    assert left(words_of(html), {*names(document), *SYMBOLS}) == set()


def test_boxes_of_one_core_are_one_row_that_unfolds() -> None:
    document = many(5)
    for box, core in zip(document["boxes"], [1, 2, 1, 1, 3], strict=True):
        box["core"] = core
    html = page(document)
    own = rows(html, "boxes")
    assert [re.findall("box-([0-9]+)", row) for row in own] == [["1", "3", "4"], ["2"], ["5"]]
    assert "<summary>2</summary>" in own[0]


def test_a_box_unfolds_to_its_figures_by_gear() -> None:
    html = page(simpson())
    inner = html.partition("<summary>Torques, slips, speeds")[2].partition("</details>")[0]
    listed = simpson()["boxes"][0]
    assert html.count("<details>") == 1
    for name, torque in listed["gears"]["R"]["torques"].items():
        assert f'data-value="{torque!r}"'.replace('.0"', '"') in inner, name
    assert "known as simpson" in words(html)


@pytest.mark.slow
def test_of_many_boxes_those_are_drawn_that_tell_most(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(boxes, "MOST_SHOWN_BOXES", 1)
    html = page(many(50))
    assert len(rows(html, "boxes")) == 50
    assert len(rows(html, "boxes", 2)) == 17
    assert "49 more are in the table only" in html
    assert html.count("Stick diagram of box") == 2  # as a heading, and for those who do not see


def test_without_matplotlib_the_tables_are_there(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(boxes, "missing", lambda *_: "a picture needs the package matplotlib")
    html = page(simpson())
    assert "There are no pictures: a picture needs the package matplotlib" in html
    assert "<svg" not in html
    assert len(rows(html, "diagrams")) == 4


@pytest.mark.slow
def test_the_files_of_a_directory() -> None:
    made = box_pages(listing_of(simpson()))
    assert list(made) == ["boxes.html", "boxes.svg"]
    assert made["boxes.svg"].startswith(b"<?xml")
    assert made["boxes.html"].startswith(b"<!DOCTYPE html>")
