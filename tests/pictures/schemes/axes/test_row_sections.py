"""Gearboxes of several planetary sets on one of the axes are half-sections without crossings."""

import re
from dataclasses import replace
from itertools import islice
from random import Random
from xml.etree import ElementTree as ET

import pytest

import vstatics
from tests.chance import with_slow
from tests.commands import CASES
from tests.installed import needs
from tests.pictures.schemes.axes.boxes import SVG, axes_by_link, of_class, svg_of, wheels
from tests.pictures.schemes.axes.test_axes import check_bridged, colors_of
from tests.pictures.schemes.lines import assert_connected, crossings
from tests.pictures.schemes.test_coaxial import next_box, planar_boxes
from vstatics import Mechanism, Transmission
from vstatics.pictures import picture
from vstatics.pictures.drawing.style import Style


def transaxle(box: Transmission) -> Transmission:
    """A box, and a pair from its output to a second axis."""
    last = box.links + 1
    pair = Mechanism(box.output, last, 0, -3.2)
    mechanisms = [*box.mechanisms, pair]
    return replace(box, links=last, link_names=(), mechanisms=mechanisms, output=last)


@pytest.mark.parametrize("count", with_slow([2, 4], [25]))
def test_planar_boxes_before_a_final_drive_are_drawn_without_crossings(count: int) -> None:
    for box in planar_boxes(count):
        case = transaxle(box)
        root = svg_of(case)
        assert_connected(root)
        assert check_bridged(root) == crossings(root) == 0
        heights = axes_by_link(root)
        assert heights[str(case.input)] == heights[str(box.output)] != heights[str(case.output)]
        wheel, other = wheels(root)
        assert wheel.x == pytest.approx(other.x, abs=0.1)


@needs("synthesis")
@pytest.mark.slow
def test_a_title_says_how_often_links_cross() -> None:
    from vstatics.synthesis import box_is_planar

    boxes = (next_box(Random(seed)) for seed in range(100))  # noqa: S311
    others = islice((box for box in boxes if not box_is_planar(box)), 3)
    told = []
    for case in map(transaxle, others):
        count = len(of_class(svg_of(case), "crossing"))
        title = picture(vstatics.solve(case), "stick", Style()).texts[0].get_text()
        said = re.search(r"(\d+) crossing", title)
        assert count == int(said[1] if said else 0)
        told.append(count)
    assert any(told)


def test_the_gearbox_of_a_driveline_is_drawn_like_the_gearbox_alone() -> None:
    orders, root = [], ET.Element("svg")
    for name in ("zf-8hp70", "driveline-8hp70"):
        root = svg_of(vstatics.load(CASES / f"{name}.yaml"))
        at = {
            one.text: float(one.attrib["x"]) for one in root.iter(f"{SVG}text") if "x" in one.attrib
        }
        orders.append(sorted(("P1", "P2", "P3", "P4", "A", "B", "C", "D", "E"), key=at.__getitem__))
    assert orders[0] == orders[1]
    assert check_bridged(root) == crossings(root) == 0
    assert len(of_class(root, "axis")) == 2


def test_a_link_is_pale_from_where_it_carries_nothing() -> None:
    # driveline-8hp70, gear 1: E and D are open, so carrier 3 and ring 2 carry nothing
    # (`vstatics run`); input and output carry torque on both sides of the half-section
    colors, style = colors_of("driveline-8hp70", "link"), Style()
    assert [colors[link] for link in ("carrier 3", "ring 2")] == [{style.faint}] * 2
    assert colors["input"] == {style.ink}
    assert style.ink in colors["output"]
