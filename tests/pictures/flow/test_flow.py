"""The picture of the power flow: bands as wide as their power, texts that can be read."""

import json
from collections import Counter
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any, Literal
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Patch, PathPatch
from matplotlib.path import Path as PlotPath

from tests.chance import some
from tests.commands import LOCKED, NEUTRAL, SHIPPED, TIED_UP
from tests.pictures.drawn import texts
from tests.pictures.schemes.test_schemes import overlaps
from tests.shipped import shipped_results
from vstatics import Gear, Load, Mechanism, Results, Transmission, load, solve
from vstatics.core import readers
from vstatics.core.flow.circulation import Node
from vstatics.core.flow.power import flows
from vstatics.core.flow.power_flow import PowerFlow
from vstatics.pictures import picture, render
from vstatics.pictures.drawing.style import Style
from vstatics.pictures.drawing.svg import SVG
from vstatics.pictures.flow.picture import placed
from vstatics.pictures.flow.places import FlowLayout, Line, Stub

SOME = ("zf-8hp70.yaml", "mercedes-9g.yaml", "toyota-p410.yaml", "self-locking.yaml")
"""A loop, two of them, several inputs and outputs, a gear self-locking."""
EACH = [
    pytest.param(path, id=path.name, marks=() if path.name in SOME else pytest.mark.slow)
    for path in SHIPPED
]
WIDE = Style(width=2000.0)
"""Every gear has one row."""
DRAWN = [
    pytest.param(path, id=path.name, marks=() if path.name in SOME[3:] else pytest.mark.slow)
    for path in SHIPPED
    if path.name in SOME[3:] or path in some(SHIPPED)
]
"""Drawing all gears takes longer."""


def layouts(results: Results) -> list[tuple[PowerFlow, FlowLayout]]:
    return [(side, row) for side, rows in in_rows(results, WIDE) for row in rows]


def bands(figure: Figure) -> Iterator[tuple[str, PlotPath]]:
    """What each band says, and its edge, in pixels."""
    drawn = (one for one in figure.artists if isinstance(one, Patch) and one.get_gid())
    for band in (one for one in drawn if " → " in json.loads(str(one.get_gid()))["title"]):
        middle: Any = band.get_transform().transform_path(band.get_path())
        if not isinstance(band, PathPatch):  # hatched
            yield json.loads(str(band.get_gid()))["title"], middle
            continue
        curves = [curve for curve, code in middle.iter_bezier() if code != middle.MOVETO]
        points = np.concatenate([curve(np.linspace(0, 1, 100)) for curve in curves])
        points = points[np.append(True, np.hypot(*np.diff(points, axis=0).T) > 1e-6)]
        normals = np.gradient(points, axis=0)[:, ::-1] * [-1, 1]
        normals /= np.hypot(*normals.T)[:, None]
        half = normals * band.get_linewidth() * figure.dpi / 72 / 2
        edge = np.concatenate([points + half, (points - half)[::-1]])
        yield json.loads(str(band.get_gid()))["title"], PlotPath(edge)


def assert_readable(figure: Figure) -> None:
    """No text covers another or a band, none is cut off."""
    figure.set_dpi(150)
    assert overlaps(figure, rounded=0) == []
    canvas: Any = FigureCanvasAgg(figure)
    ink = canvas.get_renderer()
    boxes = [(text.get_text(), text.get_window_extent(ink)) for text in figure.texts]
    for band, edge in bands(figure):
        for name, box in boxes:
            assert not name or not edge.intersects_bbox(box), f"{name!r} stands on {band!r}"


def said_by(figure: Figure) -> str:
    return "\n".join(texts(figure))


def titles(results: Results, gear: int, style: Style | None = None) -> dict[str, str]:
    """What nodes, ports and bands say, by how it begins."""
    drawn = render(results, "flow", "svg", style or Style(), [gear])
    root = ET.fromstring(drawn)  # noqa: S314 - our own
    said = [one.text or "" for one in root.iter(f"{{{SVG}}}title")]
    return {text.partition(":")[0]: text.partition(": ")[2] for text in said}


def in_rows(results: Results, style: Style) -> list[tuple[PowerFlow, list[FlowLayout]]]:
    """Gears that have a flow, each in its rows."""
    found = flows(results)
    drawn = zip((each.lossy or each.ideal for each in found), placed(found, style), strict=True)
    return [(side, rows) for side, rows in drawn if side is not None and rows]


@pytest.mark.parametrize("style", [WIDE, Style()], ids=["one row", "170 mm"])
@pytest.mark.parametrize("path", EACH)
def test_every_edge_and_every_loop_is_a_band_as_wide_as_its_power(path: Path, style: Style) -> None:
    """The powers are those of `vstatics flow`; the scale is one for all gears."""
    scales: set[float] = set()
    for side, rows in in_rows(solve(load(path)), style):
        every_line = [line for row in rows for line in row.lines]
        transmitted: dict[tuple[Node, Node], Line | Stub] = {
            (line.band.source, line.band.target): line
            for line in every_line
            if line.band.loop is None
        }
        for stub in (stub for row in rows for stub in row.stubs):
            ends = stub.port.node, stub.link
            ends = ends if stub.port.enters else ends[::-1]
            if stub.port.cut is not None:
                ends = stub.port.cut[:2]
            transmitted[ends] = stub
        wanted = {(e.source, e.target): e.power for e in side.forward if e.target.kind != "drag"}
        assert transmitted.keys() == wanted.keys()
        scales.update(round(line.width / wanted[pair], 6) for pair, line in transmitted.items())
        for number, loop in enumerate(side.loops):
            lines = [line for line in every_line if line.band.loop == number]
            pairs = Counter(pair for line in lines for pair in line.band.pairs)
            assert pairs == Counter(pairwise([*loop.nodes, loop.nodes[0]]))
            scales.update(round(line.width / loop.power, 6) for line in lines)
            assert any(line.band.back for line in lines)
        every_box = [box for row in rows for box in row.boxes]
        losses = {box.cell.run[0]: box.cell.loss for box in every_box if box.cell.lost}
        scales.update(round(losses[n] / p, 6) for n, p in side.losses.items() if p > 1e-6)
    assert len(scales) == 1


@pytest.mark.parametrize("path", EACH)
def test_what_is_transmitted_runs_from_left_to_right_within_the_picture(path: Path) -> None:
    for _, made in layouts(solve(load(path))):
        for line in made.lines:
            forth = all(left < right + 1e-6 for (left, _), (right, _) in pairwise(line.points))
            assert forth is not line.band.back
            for x, y in line.points:
                assert 0 <= x <= made.width
                assert 0 <= y <= made.height
        for box in made.boxes:
            assert 0 <= box.left < box.right <= made.width
            assert 0 <= box.top <= box.bottom <= made.height


@pytest.mark.parametrize("path", DRAWN)
def test_no_text_covers_another_or_is_cut_off(path: Path) -> None:
    assert_readable(picture(solve(load(path)), "flow", Style("ru")))


def recirculating(load: Load | None = None) -> Transmission:
    """Input at the sun, output at the carrier; the input drives the ring by a gear pair.

    By Willis's equation the carrier turns at (1 + 2 * -1/4) / 3 = 1/6, its torque is -6 by
    the power balance. The ring has 2/3 of it, 4, and with -1/4 gives back the power 1: twice
    the power that enters goes through the set, once the power that enters goes round.
    """
    mechanisms = [Mechanism(1, 2, 3, -2.0, name="set"), Mechanism(1, 2, 0, -4.0, name="pair")]
    names = ("in", "side", "out")
    return Transmission(3, [], mechanisms, [Gear()], link_names=names, load=load)


def test_a_loop_tells_its_power_and_its_part_of_the_power_in() -> None:
    for is_dark in (False, True):
        told = said_by(picture(solve(recirculating()), "flow", Style("en", is_dark), [1]))
        assert "recirculating power 1.000: 100.0% of the power in" in told
        assert "set\n2.000" in told


def test_a_loop_that_may_not_be_in_the_metal_says_so() -> None:
    said: dict[Literal["en", "ru"], str] = {
        "en": "may be an artefact of the model: D7 and D8 share sun 1 and carrier",
        "ru": "возможно, лишь в модели: у D7 и D8 общие sun 1 и carrier",
    }
    for language, words in said.items():
        figure = picture(shipped_results("umdm-reduced.yaml"), "flow", Style(language), [5])
        assert words in said_by(figure)
        assert_readable(figure)


@pytest.mark.parametrize("language", ["en", "ru"])
def test_what_a_convention_divides_is_marked_and_named(language: Literal["en", "ru"]) -> None:
    """In gear 6 the clutch E holds P3 as one piece; C and D stand in series with it."""
    results = shipped_results("zf-8hp70.yaml")
    words = {"en": "by convention", "ru": "условно"}[language]
    marked = {name for name, said in titles(results, 6, Style(language)).items() if words in said}
    ways = {"C → ring 3": False, "ring 3 → E": True, "E → ring 2": True, "ring 2 → P3": True}
    ways |= {"ring 3 → P3": True, "P3 → carrier 3": False, "carrier 3 → D": False}
    assert {name for name in marked if "→" not in name} == {"ring 2", "E", "P3"}
    assert {name for name in marked if "→" in name} == {way for way, so in ways.items() if so}
    assert_readable(picture(results, "flow", Style(language), [6]))


def test_with_a_load_powers_are_in_kilowatts_too() -> None:
    """100 N*m at 955 rpm are 955 / 60 * 2 pi * 100 W = 10.0 kW."""
    figure = picture(solve(recirculating(Load(955.0, 100.0))), "flow", Style())
    assert "set\n2.000\n20.0 kW" in said_by(figure)
    assert "recirculating power 1.000, 10.0 kW" in said_by(figure)
    assert_readable(figure)


def test_a_gear_without_power_says_so() -> None:
    for deck, words in (
        (NEUTRAL, "no flow of power: torques do not balance"),
        (TIED_UP, "no flow of power: tied up"),
        (LOCKED, "self-locking; drawn without losses"),
    ):
        figure = picture(solve(readers.read(deck.encode(), "case.yaml").case), "flow", Style(), [1])
        assert words in said_by(figure)
        assert_readable(figure)


def test_one_gear_alone_is_as_large_as_it_needs_to_be() -> None:
    results = shipped_results("simpson.yaml")
    everything, reverse = (picture(results, "flow", Style(), gears) for gears in ([], [4]))
    assert "gear R" in said_by(reverse)
    assert "gear 1" not in said_by(reverse)
    assert reverse.get_figheight() < everything.get_figheight() / 2


def test_drag_of_a_link_leaves_as_a_loss() -> None:
    """A pair of ratio 2 without losses: half of the torque .1 at the fast link costs .1."""
    case = Transmission(2, [], [Mechanism(1, 2, 0, 2.0, name="pair")], [Gear(drag={1: 0.1})])
    [(_, made)] = layouts(solve(case))
    [box] = [box for box in made.boxes if box.cell.lost]
    scale = next(stub.width for stub in made.stubs if stub.port.enters)
    assert (str(box.cell.run[0]), box.cell.lost) == ("1", "0.100")
    assert box.cell.loss == pytest.approx(0.1 * scale)


def test_coasting_runs_from_the_output_to_the_input() -> None:
    case = Transmission(2, [], [Mechanism(1, 2, 0, 2.0, 0.95, name="pair")], [Gear()])
    [(_, made)] = layouts(solve(case, coast=True))
    order = [str(box.cell.run[0]) for box in sorted(made.boxes, key=lambda box: box.middle)]
    assert order == ["2", "pair", "1"]
    ends = {(str(stub.port.node), str(stub.link), stub.port.enters) for stub in made.stubs}
    assert ends == {("output", "2", True), ("input", "1", False)}


def test_what_stands_in_series_without_loss_is_one_run() -> None:
    """From the input through the clutch C to ring 3 nothing branches: P4 is the next loss."""
    [made, *_] = [made for _, made in layouts(shipped_results("zf-8hp70.yaml"))]
    runs = {" ".join(map(str, box.cell.run)) for box in made.boxes}
    assert runs == {"input C ring 3", "P4", "output"}


def test_nodes_and_bands_say_power_torque_and_speed() -> None:
    """By Willis's equation and the balance of power, see `recirculating`."""
    said = titles(solve(recirculating()), 1)
    assert said["in → set"] == "power 1.000, torque 1.000, speed 1.000, recirculating power"
    assert said["side"] == "power 1.000, torque 4.000, speed −0.250"
    [head, *members] = said["set"].split("\n")
    assert head == "power 2.000"
    assert members == [
        "in: torque 2.000, speed 1.000",
        "side: torque 4.000, speed −0.250",
        "third (out): torque −6.000, speed 0.167",
    ]
    assert said["output"] == "power 1.000, torque 6.000, speed 0.167"
