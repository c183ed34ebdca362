"""The picture of found boxes, and the stick diagrams of boxes without teeth."""

import itertools
import math
from typing import Any

import pytest
from matplotlib.figure import Figure
from matplotlib.text import Text

from tests.pictures.drawn import texts, titled
from tests.pictures.schemes.axes.boxes import parsed
from tests.pictures.schemes.lines import assert_connected, bridges, crossings, wires
from tests.pictures.schemes.test_schemes import overlaps
from tests.synthesis.boxes import hand_boxes
from tests.synthesis.boxes.listed_boxes import many, simpson, zf_6hp
from vstatics import CaseError
from vstatics.pictures.drawing.files import figures_of, settings_of
from vstatics.pictures.drawing.style import PAGE_HEIGHT, POINTS_PER_MILLIMETRE, Style
from vstatics.pictures.drawing.svg import written_as_svg
from vstatics.pictures.schemes.bare import bare_stick
from vstatics.synthesis.boxes.box import BoxSearch, FoundBox
from vstatics.synthesis.boxes.figures.case import box_case
from vstatics.synthesis.boxes.figures.planar import box_is_planar
from vstatics.synthesis.boxes.listing import drawn_boxes
from vstatics.synthesis.boxes.reading import listing_of
from vstatics.synthesis.pictures.picture import draw_boxes, render_boxes
from vstatics.synthesis.pictures.points import box_scale
from vstatics.synthesis.pictures.stick import stick_diagram


def drawn(document: dict[str, Any], most: int = 8, style: Style | None = None) -> Figure:
    listing, style = listing_of(document), style or Style()
    [figure] = figures_of(draw_boxes(listing, style, drawn_boxes(listing, most)))
    return figure


def test_one_box_has_its_point_and_its_diagram() -> None:
    document = simpson()
    figure = drawn(document)
    said = texts(figure)
    assert "Found boxes: 1" in said
    assert "27885 looked at, 1 family with equal ratios" in said
    assert {"1", "family 1 (1)", "Pareto list", "P1", "P2", "A", "B", "C", "D"} <= set(said)
    [(_, point)] = [one for one in titled(figure) if one[0].startswith("1: family 1, loss ")]
    [name] = [text for text in figure.texts if text.get_text() == "P1"]
    assert name.get_window_extent().y1 < point.get_window_extent().y0
    ratios = {name: gear["ratio"] for name, gear in document["boxes"][0]["gears"].items()}
    forward = [ratio for ratio in ratios.values() if ratio > 0]
    whole = " ".join(said).replace("−", "-")
    for gear, ratio in ratios.items():
        assert f"{gear}: {ratio:.3f}" in whole
    assert f"spread {max(forward) / min(forward):.3f}" in whole
    with pytest.raises(CaseError, match="no gearbox was found, so there is nothing to draw"):
        drawn({"searched": 10, "boxes": []})


def test_the_scales_of_a_narrow_page_can_be_read() -> None:
    assert overlaps(drawn(simpson(), style=Style("ru", width=85 * POINTS_PER_MILLIMETRE))) == []


def test_a_held_link_and_meshed_planets_are_drawn() -> None:
    """Lepelletier: one sun stands for good, one set has two rows of planets."""
    [box] = listing_of(zf_6hp()).boxes
    canvas = bare_stick(box.transmission(), Style()).drawn().canvas
    svg = written_as_svg(canvas, "box")
    assert "housing" in wires(parsed(svg))
    said = {*canvas.texts}
    assert {"P1-P2", "P3", "T-L0", "T-L1", "F-L0-L5", "F-L1-L6", "F-L3-L5"} <= said
    assert {"L0", "L1", "L2", "L3", "L5", "L6"} <= said


@pytest.mark.slow
@pytest.mark.parametrize("is_small", [False, True])
@pytest.mark.parametrize(
    ("search", "box"),
    [
        (hand_boxes.ZF_8HP_SEARCH, hand_boxes.ZF_8HP),
        (hand_boxes.ZF_6HP_SEARCH, hand_boxes.ZF_6HP),
        (hand_boxes.CROWDED_SEARCH, hand_boxes.CROWDED),
    ],
)
def test_diagrams_can_be_read_and_join_what_the_case_joins(
    search: BoxSearch, box: FoundBox, is_small: bool
) -> None:
    case = box_case(box, search.targets, 0.98)
    stick = bare_stick(case, Style(), is_small=is_small)
    canvas = stick.drawn("" if is_small else case.name).canvas
    root = parsed(written_as_svg(canvas, "box"))
    assert crossings(root) == bridges(root)
    assert (crossings(root) == 0) == box_is_planar(case)
    assert_connected(root)
    assert overlaps(figures_of([canvas])[0]) == []


def numbers(figure: Figure) -> list[Text]:
    return [text for said, text in titled(figure) if said.startswith("boxes ")]


@pytest.mark.slow
def test_points_that_coincide_share_their_numbers() -> None:
    """Of each family of three the first two stand at one place, which counts them."""
    assert [text.get_text() for text in numbers(drawn(many(3), most=3))] == ["1, 2", "3"]
    assert [text.get_text() for text in numbers(drawn(many(3), most=1))] == ["1 +1"]


@pytest.mark.slow
def test_numbers_of_many_boxes_cover_no_other_and_no_point() -> None:
    figure = drawn(many(200), most=8)
    with settings_of(Style()):
        figure.canvas.draw()
        boxes = [text.get_window_extent() for text in numbers(figure)]
    assert len(boxes) == 8
    for one, other in itertools.combinations(boxes, 2):
        assert not one.overlaps(other)
    points = [one for said, one in titled(figure) if ": family " in said]
    assert len(points) > 60
    for one in points:
        at = one.get_transform().transform(one.get_xydata())[0]
        assert not any(box.contains(*at) for box in boxes)
    assert any(text.endswith("others") for text in texts(figure))


@pytest.mark.slow
def test_boxes_without_figures_have_no_point_but_are_named() -> None:
    document = many(3)
    document["boxes"][0] |= {"loss": None, "torque": None}
    said = texts(drawn(document, most=1))
    assert any("; without loss or torque: 1" in text for text in said)
    assert not any("nan" in text for text in said)
    document["boxes"] = document["boxes"][:1]
    assert "Found boxes: 1" in texts(drawn(document))


@pytest.mark.slow
def test_figures_that_differ_widely_have_scales_of_logarithms() -> None:
    document = many(6)
    document["boxes"][5] |= {"torque": 200.0, "loss": 0.0}
    assert {"2", "5", "10", "20", "50", "100", "200"} <= set(texts(drawn(document, most=1)))
    assert box_scale([3.0, 3.0 + 1e-12])[:2] == pytest.approx((2.85, 3.15))  # but for rounding
    x, y = box_scale([2.0, 2.3, 200.0]), box_scale([0.0, 1.0, 1.2])
    assert (x.is_log, y.is_log) == (True, False)
    assert x.low < 2.0
    assert 200.0 < x.high < math.inf


@pytest.mark.slow
def test_the_same_boxes_give_the_same_picture() -> None:
    document = zf_6hp()
    del document["boxes"][0]["case"]["name"]
    listing = listing_of(document)
    assert b"<svg" in stick_diagram(listing.boxes[0].transmission())
    for form in ("svg", "png", "pdf"):
        first, again = (render_boxes(listing, form, Style("ru", dark=True)) for _ in range(2))
        assert first == again


@pytest.mark.slow
def test_diagrams_go_on_on_further_pages_of_a_width() -> None:
    listing, style = listing_of(many(200)), Style(height=PAGE_HEIGHT)
    shown = drawn_boxes(listing, 8)
    pages = draw_boxes(listing, style, shown)
    assert len(pages) > 1
    headings = [one for page in pages for one in texts(page) if "   family " in one]
    assert [int(one.split()[0]) for one in headings] == [box.number for box in shown]
    for page in pages:
        wide, high = page.size
        assert wide <= style.width
        assert high <= style.height
