"""Stick diagrams of boxes with several axes, read from their SVG as a reader would."""

import json
import random
from dataclasses import replace
from itertools import combinations, permutations
from xml.etree import ElementTree as ET

import pytest

import vstatics
from tests.chance import with_slow
from tests.commands import CASES
from tests.pictures.drawn import texts
from tests.pictures.schemes.axes.boxes import (
    PAIRS,
    SVG,
    axes_by_link,
    countershaft_box,
    of_class,
    one_pair,
    points,
    six_speed,
    svg_of,
    wheels,
)
from tests.pictures.schemes.lines import assert_connected, strokes, wires
from vstatics.core.elements.drawing import drawing_of
from vstatics.core.model.transmission import Transmission
from vstatics.pictures import pages, picture
from vstatics.pictures.drawing.style import PAGE_HEIGHT, PAGE_WIDTH, Style
from vstatics.pictures.schemes.axes.recognition import parallel_axes
from vstatics.pictures.schemes.scheme import scheme_of

ROUNDED = 0.1
"""By how much two places may differ that SVG has with two decimals, and scaled. [pt]"""
WHEELS = {"differential", "right wheel", "left wheel"}
KNOWN = {
    # by hand: what shift elements, shafts, coaxial sets and springs of two links join
    "two-stage": [
        {"input", "wheel 1", "wheel 2", "wheel 3", "main shaft", "axle"},
        {"countershaft"},
    ],
    "dual-clutch-wheels": [{"engine", "odd", "even"}, {"l1", "l2", "l3", "l4", "upper"}, {"diff"}],
    "toyota-p410": [{"engine", "MG1", "MG2", "ring"}, {"counter shaft"}, WHEELS],
    "power-split": [{"engine", "MG1", "ring"}, {"MG2"}, WHEELS],
}
WITH_AXES = [*KNOWN, "moskvich412", "driveline-8hp70"]


def load(name: str) -> Transmission:
    return vstatics.load(CASES / f"{name}.yaml")


@pytest.fixture(scope="module", params=[*KNOWN, "moskvich412"])
def shown(request: pytest.FixtureRequest) -> tuple[Transmission, ET.Element]:
    case = load(request.param)
    return case, svg_of(case)


def test_links_of_one_axis_are_those_that_turn_about_it() -> None:
    for name, known in KNOWN.items():
        case = load(name)
        scheme = scheme_of(case)
        axes = parallel_axes(scheme, case)
        assert axes is not None
        found = [{scheme.name(link) for link in axis} for axis in axes.axes]
        assert found[0] == known[0]  # that of the input comes first
        assert sorted(map(sorted, found)) == sorted(map(sorted, known))


def test_a_bevel_pinion_and_the_casing_of_its_axle_are_of_two_axes() -> None:
    case = load("moskvich412")
    scheme = scheme_of(case)
    axes = parallel_axes(scheme, case)
    assert axes is not None
    number = {name: axes.of(place) for place, name in enumerate(scheme.links, 1)}
    assert number["pinion"] == number["engine"] != number["wheels"]
    assert number["axle casing"] == number["wheels"] == number["vehicle"]


def test_boxes_about_one_axis_have_no_rows() -> None:
    for path in sorted(CASES.glob("*.yaml")):
        case = vstatics.load(path)
        assert (parallel_axes(scheme_of(case), case) is not None) == (path.stem in WITH_AXES), path


def check_wheels(case: Transmission, root: ET.Element) -> None:
    """Both wheels of a pair in one plane, on their axes, touching at their pitch circles."""
    heights = axes_by_link(root)
    by_pair: dict[str, list[tuple[float, float, float, str]]] = {}
    for one in wheels(root):
        middle, radius = (one.low + one.high) / 2, (one.high - one.low) / 2
        assert middle == pytest.approx(heights[one.link], abs=ROUNDED + 2)
        by_pair.setdefault(one.mechanism, []).append((one.x, heights[one.link], radius, one.link))
    teeth = {one.name: one.teeth for one in drawn.elements} if (drawn := drawing_of(case)) else {}
    rows = sorted(set(heights.values()))
    for name, ((x, y, radius, _), (x2, y2, radius2, _)) in by_pair.items():
        assert x == pytest.approx(x2, abs=ROUNDED)
        low, high = sorted((y, y2))
        is_next = not any(low + ROUNDED < row < high - ROUNDED for row in rows)
        if is_next and len(teeth.get(name, ())) == 2:
            assert radius + radius2 == pytest.approx(high - low, abs=2 * ROUNDED)
            first, second = teeth[name].values()
            if min(radius, radius2) > 12:  # small ones are drawn larger, to be seen
                assert radius / radius2 == pytest.approx(first / second, rel=0.05)


def check_apart(root: ET.Element) -> None:
    for one, other in combinations(wheels(root), 2):
        if one.mechanism != other.mechanism and abs(one.x - other.x) < 5:
            assert one.low > other.high - ROUNDED or other.low > one.high - ROUNDED


def check_bridged(root: ET.Element) -> int:
    """Wires of two links meet where a crossing bridges them, and nowhere else."""
    own = [(name, line) for name, some in wires(root).items() for line in some]
    bridges = [points(one) for one in of_class(root, "crossing")]
    middles = [((a[0] + b[0]) / 2, (a[1] + b[1]) / 2) for a, b in bridges]
    met = set()
    for (name, level), (other_name, upright) in permutations(own, 2):
        x, y = upright.x, level.y
        if name == other_name or y != level.y2 or x != upright.x2:
            continue
        is_within = level.x + ROUNDED < x < level.x2 - ROUNDED
        if is_within and upright.y + ROUNDED < y < upright.y2 - ROUNDED:
            assert any(abs(x - at) + abs(y - up) < ROUNDED for at, up in middles)
            met.add((round(x, 1), round(y, 1)))
    assert len(bridges) >= len(met)
    return len(met)


def check_built(case: Transmission, root: ET.Element) -> int:
    """Check wheels and wires as if the box were built; return how often links cross."""
    check_wheels(case, root)
    check_apart(root)
    assert_connected(root)
    return check_bridged(root)


def test_shipped_boxes_can_be_built_and_have_all_that_is_theirs(
    shown: tuple[Transmission, ET.Element],
) -> None:
    case, root = shown
    assert check_built(case, root) == 0
    axes = [{y for _, y in points(one)} for one in of_class(root, "axis")]
    assert {len(levels) for levels in axes} == {1}
    assert len({*map(frozenset, axes)}) == len(axes)
    assert float(root.attrib["width"].removesuffix("pt")) <= PAGE_WIDTH + 0.01
    scheme = scheme_of(case)
    devices = [*of_class(root, "element"), *of_class(root, "mechanism")]
    assert {one.get("data-name") for one in devices} == {device.name for device in scheme.devices}
    assert {one.get("data-name") for one in of_class(root, "link")} == set(scheme.links)
    assert {one.get("data-port") for one in of_class(root, "port")} == {"input", "output"}


@pytest.mark.parametrize("seed", with_slow([3, 0, 1, 2, 4, 5], range(100, 130)))
def test_boxes_made_by_chance_can_be_built(seed: int) -> None:
    case = countershaft_box(random.Random(seed))  # noqa: S311 - no secret
    check_built(case, svg_of(case))


def colors_of(name: str, *kinds: str) -> dict[str, set[str]]:
    """Of lines in the first gear, by the names of their groups."""
    figure = picture(vstatics.solve(load(name)), "stick", Style(), (1,))
    colors: dict[str, set[str]] = {}
    for one in figure.findobj():
        gid = one.get_gid() or ""
        for group in json.loads(gid)["groups"] if gid.startswith("{") else ():
            if group[0] in kinds and hasattr(one, "get_color"):
                data = dict(group[1])
                key = data.get("name") or f"{data['mechanism']} {data['link']}"
                colors.setdefault(key, set()).add(str(one.get_color()))
    return colors


def test_what_leads_to_a_port_is_pale_only_where_it_takes_nothing() -> None:
    # toyota-p410, hybrid: engine and both machines take or give power (`vstatics flow`)
    colors = colors_of("toyota-p410", "link")
    assert [colors[link] for link in ("engine", "MG1", "MG2")] == [{Style().ink}] * 3


def test_a_dog_that_carries_nothing_is_marked_and_pale_behind() -> None:
    # dual-clutch-wheels, gear 1: d2 waits for gear 2, its wheel turns without load
    colors, style = colors_of("dual-clutch-wheels", "element", "wheel"), Style()
    assert style.engaged in colors["d1"]
    assert style.engaged in colors["d2"]
    assert style.engaged not in colors["d3"]
    assert colors["p2 l2"] == {style.faint}
    assert colors["p1 l1"] == {style.ink}


def test_wheels_have_their_teeth_on_request() -> None:
    results = vstatics.solve(load("dual-clutch-wheels"))
    bare, full = (texts(picture(results, "stick", Style(wheels=own))) for own in (False, True))
    teeth = [14, 48, 26, 41, 19, 42, 35, 38, 16, 68]
    assert sorted(full) == sorted([*bare, *map(str, teeth)])


@pytest.mark.parametrize("name", with_slow(["power-split", "toyota-p410"], ["driveline-8hp70"]))
def test_road_wheels_stand_at_the_ends_of_the_half_shafts(name: str) -> None:
    root = svg_of(load(name))
    heights = axes_by_link(root)
    middles = {}
    for group in of_class(root, "road-wheel"):
        paths = [path for path in group.iter(f"{SVG}path") if path.get("d")]
        xs, ys = zip(*(at for path in paths for at in points(path)), strict=True)
        link = group.attrib["data-link"]
        middles[link] = (min(xs) + max(xs)) / 2
        assert (min(ys) + max(ys)) / 2 == pytest.approx(heights[link], abs=ROUNDED)
        for other in wheels(root):  # no gear wheel stands where they do
            is_beside = other.x < min(xs) - 2 or other.x > max(xs) + 2
            assert is_beside or other.high < min(ys) or other.low > max(ys)
    assert set(middles) == {"left wheel", "right wheel"}
    low, high = sorted(middles.values())
    axis = [link for link, y in heights.items() if y == heights["left wheel"]]
    for link, own in wires(root).items():
        for line in own if link in axis else ():
            assert low - ROUNDED <= line.x <= line.x2 <= high + ROUNDED


def dots(root: ET.Element) -> set[tuple[str, float, float]]:
    """The links and places of all dots."""
    found = set()
    for group in of_class(root, "link"):
        for path in group.iter(f"{SVG}path"):
            ends = points(path) if path.get("class") != "wire" else []
            for (x, y), (x2, y2) in zip(ends[::2], ends[1::2], strict=False):
                if abs(x2 - x) < 0.5 and y == y2:
                    found.add((group.attrib["data-name"], x, y))
    return found


def branches(root: ET.Element) -> set[tuple[str, float, float]]:
    """Where an upright line of a link begins within a level one, but for those to its wheels."""
    webs = [(one.link, one.x) for one in wheels(root)]
    found = set()
    for name, own in wires(root).items():
        for upright, level in permutations(own, 2):
            x = upright.x
            is_web = any(name == link and abs(x - at) < 1 for link, at in webs)
            is_inside = level.x + ROUNDED < x < level.x2 - ROUNDED
            if x == upright.x2 and not is_web and is_inside and level.y == level.y2:
                found |= {(name, x, y) for y in (upright.y, upright.y2) if y == level.y}
    return found


@pytest.mark.parametrize("name", ["two-stage", "dual-clutch-wheels", "moskvich412"])
def test_links_have_dots_where_they_branch_but_not_at_their_wheels(name: str) -> None:
    root = svg_of(load(name))
    drawn, wanted = dots(root), branches(root)
    assert wanted
    assert wanted <= drawn
    for link, x, y in drawn - wanted:  # where several signs hang on one upright line
        assert name == "moskvich412"
        own = wires(root)[link]
        assert any(line.x == line.x2 == x and line.y < y < line.y2 for line in own)
    assert not of_class(root, "road-wheel")  # none of them has an axle


@pytest.mark.parametrize("kind", PAIRS)
def test_a_pair_of_every_kind_stands_on_two_axes(kind: str) -> None:
    case = one_pair(kind)
    root = svg_of(case)
    assert_connected(root)
    assert check_bridged(root) == 0
    first, second = sorted(wheels(root), key=lambda one: one.link)
    assert first.x == pytest.approx(second.x, abs=ROUNDED + 10 * (kind == "internal_pair"))
    teeth = [*PAIRS[kind].values()]
    sizes = (first.high - first.low) / (second.high - second.low)
    if kind in ("gear_pair", "idler"):
        assert sizes == pytest.approx(teeth[0] / teeth[-1], rel=0.05)
    is_within = second.low < first.low and first.high < second.high
    assert is_within == (kind == "internal_pair")  # a pinion within the wheel, else beside it
    gap = max(first.low, second.low) - min(first.high, second.high)
    assert (gap > 10) == (kind in ("chain", "belt", "idler"))


def slanted(wheel: ET.Element) -> set[frozenset[tuple[float, float]]]:
    """Lines of a wheel that are neither level nor upright."""
    lines = [ends for path in wheel.iter(f"{SVG}path") for ends in strokes(path)]
    return {frozenset((a, b)) for a, b in lines if a[0] != b[0] and a[1] != b[1]}


def test_bevel_wheels_are_cones_that_touch_along_one_line() -> None:
    for kind, cones in (("bevel_pair", 1), ("gear_pair", 0)):
        first, second = map(slanted, of_class(svg_of(one_pair(kind)), "wheel"))
        assert (len(first), len(second), len(first & second)) == (2 * cones, 2 * cones, cones)


def gaps(root: ET.Element, kind: str, name: str) -> int:
    """How often the sign of a device on a level line is interrupted."""
    [group] = [one for one in of_class(root, kind) if one.get("data-name") == name]
    lines = [ends for path in group.iter(f"{SVG}path") for ends in strokes(path)]
    spans = sorted((min(a[0], b[0]), max(a[0], b[0])) for a, b in lines)
    end, count = spans[0][1], 0
    for low, high in spans:
        count += low > end + ROUNDED
        end = max(end, high)
    return count


@pytest.mark.parametrize("has_play", [False, True])
def test_what_is_elastic_behind_a_gap_shows_it_until_it_is_engaged(has_play: bool) -> None:
    # moskvich412: dog clutches with a stiffness; the first shaft is a plain spring
    case = load("moskvich412")
    if has_play:
        shaft, *others = case.springs
        loose = shaft._replace(compliance=None, points=[(0, 0), (0.1, 0), (0.2, 300)])
        case = replace(case, springs=[loose, *others])
    bare, gear = svg_of(case), svg_of(case, (1,))
    assert [gaps(bare, "element", one) for one in ("damper", "shaft 1", "shaft 2")] == [1, 1, 1]
    assert [gaps(gear, "element", one) for one in ("damper", "shaft 1", "shaft 2")] == [0, 0, 1]
    assert gaps(bare, "mechanism", "first shaft") == has_play


def test_a_manual_box_has_its_idler_between_two_axes() -> None:
    case = six_speed()
    root = svg_of(case)
    assert check_built(case, root) == 0
    heights = axes_by_link(root)
    low, high = sorted((heights["counter"], heights["output"]))
    assert low < heights["idler"] < high
    assert heights["input"] == heights["output"]


def test_the_housing_of_a_brake_is_outside_of_the_ring_that_it_holds() -> None:
    case = vstatics.loads(
        "links: [motor, ring, carrier, wheels]\n"
        "shift_elements: {T: [ring, housing], F: [motor, ring]}\n"
        "mechanisms:\n"
        "  set: {first: motor, second: ring, third: carrier, ratio: -63/29}\n"
        "  final: {first: carrier, second: wheels, ratio: -41/14}\n"
        "gears: {low: [T], high: [F]}\n"
    )
    root = svg_of(case)
    (axis, *_), *_ = ([y for _, y in points(one)] for one in of_class(root, "axis"))
    ring = wires(root)["ring"]
    [brake] = [one for one in root.iter(f"{SVG}g") if one.get("data-name") == "T"]
    sign = [at for path in brake.iter(f"{SVG}path") for at in points(path)]
    assert min(y for _, y in sign) < min(line.y for line in ring) < axis  # y goes down
    assert max(y for _, y in sign) <= min(line.y for line in ring) + ROUNDED


def test_the_teeth_of_a_planet_stand_within_its_set() -> None:
    """Between those of its ring and of its sun, all at one side of the wheels."""
    style = Style(wheels=True)
    figure = picture(vstatics.solve(load("toyota-p410")), "stick", style)
    at = {one.get_text(): one.get_position() for one in figure.texts}
    for ring, planet, sun in (("78", "23", "30"), ("58", "18", "22")):
        assert at[ring][1] > at[planet][1] > at[sun][1]
        assert at[ring][0] == pytest.approx(at[planet][0], abs=0.5)


def test_many_axes_stand_on_one_page_and_a_ring_that_passes_a_shaft_crosses_it() -> None:
    """Six rows in 240 mm; the ring of an internal pair is wider than its distance: through d."""
    case = vstatics.loads(
        "links: [a, b, c, d, e, f, g, h]\noutput: h\nelements:\n"
        "  idl: {kind: idler, first: a, second: b, teeth: {first: 20, idler: 23, second: 41}}\n"
        "  intp: {kind: internal_pair, first: b, second: c, teeth: {first: 20, second: 61}}\n"
        "  blt: {kind: belt, first: c, second: d, diameters: {first: 100, second: 150}}\n"
        "  chn: {kind: chain, first: d, second: e, teeth: {first: 19, second: 38}}\n"
        "  bev: {kind: bevel_pair, first: e, second: f, teeth: {first: 13, second: 31}}\n"
        "  dp: {kind: double_planet, sun: f, ring: housing, carrier: g,"
        " teeth: {sun: 30, ring: 78, inner: 17, outer: 20}}\n"
        "  st: {kind: stepped, sun: g, ring2: housing, carrier: h,"
        " teeth: {sun: 24, ring2: 90, planet: 40, planet2: 26}}\n"
        'gears: {"1": []}\n'
    )
    [svg] = pages(vstatics.solve(case), "stick", "svg", Style(height=PAGE_HEIGHT))
    assert float(ET.fromstring(svg).attrib["viewBox"].split()[3]) <= PAGE_HEIGHT  # noqa: S314 - our own
    assert b"1 crossing" in svg
