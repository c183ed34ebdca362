"""Half-sections of what turns about one axis: no two links cross where none need."""

from __future__ import annotations

import re
import sys
import xml.etree.ElementTree as ET
from itertools import pairwise
from random import Random
from typing import Any

import networkx as nx
import pytest

import vstatics
from tests.chance import each_seed, seeded, seeds_with_slow, with_slow
from tests.commands import CASES
from tests.installed import needs
from tests.pictures.measured import measured
from tests.pictures.schemes.axes.boxes import SVG, of_class, parsed, svg_of
from tests.pictures.schemes.lines import assert_connected, bridges, crossings, lines_of, wires
from tests.pictures.schemes.test_schemes import overlaps
from tests.shipped import shipped_results
from vstatics import Gear, Mechanism, ShiftElement, Spring, Transmission
from vstatics.core.elements import Drawing, Element, transmission
from vstatics.core.elements.drawing import drawing_of
from vstatics.core.model.springs import between
from vstatics.pictures import picture, render
from vstatics.pictures.drawing.style import Style
from vstatics.pictures.drawing.svg import written_as_svg
from vstatics.pictures.paged.drawn import HALF
from vstatics.pictures.schemes.bare import bare_stick
from vstatics.pictures.schemes.coaxial.picture import coaxial_sheet
from vstatics.pictures.schemes.coaxial.planarity import has_half_section
from vstatics.pictures.schemes.coaxial.rooms import BRAKE_LENGTH
from vstatics.pictures.schemes.coaxial.search.order import component_order
from vstatics.pictures.schemes.coaxial.train import CoaxialTrain, Planes
from vstatics.pictures.schemes.planetary import sections_of
from vstatics.pictures.schemes.scheme import scheme_of
from vstatics.pictures.schemes.stick import stick_scheme
from vstatics.pictures.schemes.titles import teeth_of

FAST = ["zf-6hp26", "simpson-th400", "ravigneaux-aod", "wheel-hub"]
OTHERS = ["driveline-8hp70", "dual-clutch-wheels", "moskvich412", "power-split", "toyota-p410"]
OTHERS += ["two-stage", "moskvich-start"]
"""With several axes; springs alone."""
SLOW = sorted({path.stem for path in CASES.glob("*.yaml")} - {*FAST, *OTHERS})
CROSSED = {"umdm": 2}
"""A group of four planets on one carrier."""
IN_ROWS = {"tarasik-truck"}
"""Links that go on in another row are drawn in two pieces."""
every_case = pytest.mark.parametrize("name", with_slow(FAST, SLOW))


@every_case
def test_no_links_of_a_gearbox_cross_and_each_hangs_together(name: str) -> None:
    # gearboxes that exist are bodies of revolution one inside another
    results = shipped_results(f"{name}.yaml")
    root = parsed(render(results, "stick", "svg", Style()))
    figure = picture(results, "stick", Style())
    said = {text.get_text() for text in figure.texts}
    assert crossings(root) == bridges(root) == CROSSED.get(name, 0)
    assert any("crossing" in text for text in said) == (name in CROSSED)
    if name not in IN_ROWS:
        assert_connected(root)
    names = " ".join(" ".join(said).split())
    elements = [" ".join(element.name.split()) for element in results.case.shift_elements]
    for own in (*results.case.link_names[: results.case.own_links], *elements):
        assert own in names
    assert 72 * figure.get_size_inches()[0] <= Style().width + 0.1
    assert min(float(text.get_fontsize()) for text in figure.texts) >= 7


@every_case
def test_parts_in_svg_are_called_what_the_case_calls_them(name: str) -> None:
    results = shipped_results(f"{name}.yaml")
    case = results.case
    root = parsed(render(results, "stick", "svg", Style()))
    [axis] = of_class(root, "axis")
    assert (axis.tag, axis.get("data-axis")) == (f"{SVG}path", "1")
    links = of_class(root, "link")
    own = set(case.link_names[: case.own_links])
    assert {one.attrib["data-name"] for one in links} - {"housing"} == own
    assert {one.get("data-axis") for one in links} == {"1"}
    wires = of_class(root, "wire")
    assert {one for link in links for one in link.iter() if one.get("class") == "wire"} == {*wires}
    for one in wires:
        for x, y, x2, y2 in lines_of(one):
            assert min(x2 - x, y2 - y) < 0.02
    elements = [one.attrib["data-name"] for one in of_class(root, "element")]
    assert sorted(elements) == sorted(one.name for one in case.shift_elements)
    devices = scheme_of(case).devices
    others = [one.name for one in devices if not one.is_shift_element and one.kind != "held"]
    mechanisms = [one.attrib["data-name"] for one in of_class(root, "mechanism")]
    assert {*others} <= {*mechanisms}
    assert len(mechanisms) == len({*mechanisms})
    ports = [one.get("data-port") for one in of_class(root, "port")]
    assert set(ports) == {"input", "output"}


@every_case
def test_suns_are_below_their_planets_and_rings_above(name: str) -> None:
    # a link meets a set where its wire ends among the lines of its teeth
    results = shipped_results(f"{name}.yaml")
    root = parsed(render(results, "stick", "svg", Style()))
    lines = wires(root)
    groups = {one.attrib["data-name"]: one for one in of_class(root, "mechanism")}
    scheme = stick_scheme(results.case)
    for device in scheme.devices:
        if "carrier" not in device.members or device.kind == "bevel":
            continue
        paths = groups[device.name].iter(f"{SVG}path")
        own = [line for path in paths for line in lines_of(path)]
        left, right = min(one.x for one in own), max(one.x2 for one in own)
        high, low = min(one.y for one in own) - 0.1, max(one.y2 for one in own) + 0.1
        suns, pins, rings = [], [], []  # heights from the top of the page
        for member, link in device.members.items():
            met = lines["housing" if not link else scheme.name(link)]
            there = [one for one in met if one.x2 >= left and one.x <= right]
            if member == "carrier":
                pins += [y for x, y, x2, y2 in there if y == y2 and x2 > x and high < y < low]
            elif "sun" in member:
                suns += [y for x, y, x2, y2 in there if x == x2 and high < y < low <= y2]
            else:
                rings += [y2 for x, y, x2, y2 in there if x == x2 and high < y2 < low and y <= high]
        assert suns or rings, device.name
        assert pins, device.name
        assert all(min(pins) < sun for sun in suns), device.name
        assert all(ring < max(pins) for ring in rings), device.name
        assert not (suns and rings) or min(suns) > min(rings), device.name


def random_box(chance: Random) -> Transmission | None:
    """Two or three sets with links of each other, a few elements."""
    sets = chance.choice([2, 3])
    links = chance.randint(sets + 2, 2 * sets + 1)
    three = [chance.sample(range(1, links + 1), 3) for _ in range(sets)]
    mechanisms = [Mechanism(a, b, c, chance.choice([-2.5, -1.7, 2.1])) for a, b, c in three]
    used = sorted({link for one in mechanisms for link in one.links})
    if used != list(range(1, links + 1)):
        return None
    elements = [ShiftElement(link) for link in chance.sample(used, 2)]
    pairs = [chance.sample(used, 2) for _ in range(chance.randint(1, 3))]
    elements += [ShiftElement(one, other) for one, other in pairs]
    return Transmission(links, elements, mechanisms, [Gear([1])], input=1, output=links)


def axis_graph(case: Transmission) -> nx.Graph[object]:
    """Each body subdivided, so that nothing of `box_is_planar` is used."""
    graph: nx.Graph[object] = nx.Graph([("axis", 0), ("axis", case.input), ("axis", case.output)])
    for number, one in enumerate(case.mechanisms):
        for wheel in (one.first, one.second):
            nx.add_path(graph, [one.third, (number, wheel), wheel])
    for number, element in enumerate(case.shift_elements):
        nx.add_path(graph, [element.first, ("element", number), element.second])
    return graph


def next_box(chance: Random) -> Transmission:
    case = None
    while case is None:
        case = random_box(chance)
    return case


def planar_boxes(count: int) -> list[Transmission]:
    """Boxes that can be built with input and output along the axis."""
    chance, found = Random(30), list[Transmission]()  # noqa: S311
    while len(found) < count:
        case = next_box(chance)
        found += [case] * nx.check_planarity(axis_graph(case))[0]
    return found


def drawn(case: Transmission) -> tuple[ET.Element, str]:
    canvas = bare_stick(case, Style()).drawn("box").canvas
    return parsed(written_as_svg(canvas, "box")), canvas.texts[0]


@needs("synthesis")
@seeds_with_slow(4, 40)
def test_random_boxes_cross_where_the_title_says_so(seed: int) -> None:
    from vstatics.synthesis import box_is_planar

    case = next_box(Random(seed))  # noqa: S311
    is_planar = nx.check_planarity(axis_graph(case))[0]
    assert box_is_planar(case) == is_planar
    root, title = drawn(case)
    count = crossings(root)
    told = re.search(r"(\d+) crossing", title)
    assert count == bridges(root) == (int(told[1]) if told else 0)
    assert_connected(root)
    if is_planar:
        assert not count
    if not count:
        assert ("through the housing" in title) == (not is_planar)


@pytest.mark.parametrize("count", with_slow([2, 5], [30]))
def test_planar_boxes_are_drawn_without_crossings(count: int) -> None:
    for case in planar_boxes(count):
        root, title = drawn(case)
        assert crossings(root) == bridges(root) == 0
        assert title == "box"
        assert_connected(root)


@pytest.mark.slow
def test_a_chain_of_shafts_can_be_longer_than_the_stack_of_calls() -> None:
    count = sys.getrecursionlimit()
    shafts = [(link, link + 1) for link in range(3, count + 3)]
    steps = component_order(CoaxialTrain([Planes(3, [(1, 2)])], shafts, [2], 1, count + 3)).steps
    assert [step.number for step in steps if step.kind == "pair"] == [*range(count)]


def test_a_carrier_at_the_output_goes_down_to_the_axis_and_never_up() -> None:
    """It is level at its pin and on the axis, nowhere else."""
    teeth = "teeth: {sun: 30, ring: 70}"
    case = vstatics.loads(
        f"elements: {{P: {{kind: planetary, sun: sun, ring: ring, carrier: carrier, {teeth}}}}}\n"
        "links: [sun, ring, carrier]\n"
        "shift_elements: {T: [ring, housing], F: [sun, ring]}\n"
        "gears: {low: [T], high: [F]}\n"
    )
    own = wires(svg_of(case))
    levels = {round(y) for x, y, x2, y2 in own["carrier"] if y == y2 and x != x2}
    assert len(levels) == 2
    assert max(levels) == round(max(y for lines in own.values() for *_, y in lines))


@pytest.mark.parametrize("width", ["half", "narrow"])
@pytest.mark.parametrize("names", with_slow([FAST], [SLOW]))
def test_letters_can_be_read_beside_one_another(names: list[str], width: str, browser: Any) -> None:
    """On the width of a page all are looked at by tests/pictures/test_pages.py."""
    style = {"half": HALF, "narrow": Style(width=320.0, wheels=True)}[width]
    cases = [shipped_results(f"{name}.yaml") for name in names]
    pages = measured(browser, [render(one, "stick", "svg", style, [1]) for one in cases])
    for name, page in zip(names, pages, strict=True):
        wider = 1.1 if (name, width) == ("ravigneaux-gf4a", "half") else 1.0  # signs would be lost
        assert page.width / 25.4 * 72 <= wider * style.width + 0.1, name
        assert (page.overlaps, page.outside, page.covered) == ([], [], []), name
        assert min(size for _, size in page.letters) >= (7 if style.wheels else 8) - 0.01, name


@pytest.mark.parametrize("width", [170.0, 85.0])
@pytest.mark.parametrize("name", ["zf-8hp70", "aisin-8speed", "allison-6speed", "ford-10r80"])
def test_names_of_drums_are_below_the_plates_of_brakes(name: str, width: float) -> None:
    """A line of letters is 8 pt high, and lines are 10 pt apart; plates are 14 pt wide."""
    case, style = shipped_results(f"{name}.yaml").case, Style(width=width / 25.4 * 72)
    scheme = stick_scheme(case)
    sheet = coaxial_sheet(scheme, sections_of(scheme, case, style), style)
    assert sheet is not None
    layout, places = sheet.layout, sheet.layout.places
    tops = [x for up, x in zip(layout.uprights, places.at, strict=True) if up.kind == "top"]
    for link, (x, y) in places.names.items():
        text = layout.link_name(link)
        high = layout.letters * (8 + 10 * text.count("\n"))
        if any(abs(x - top) < layout.width(text) / 2 + 7 for top in tops):
            assert y + high / 2 <= places.housing - BRAKE_LENGTH + 0.01, text


@pytest.mark.parametrize("width", [170.0, 85.0])
def test_the_name_of_a_loose_carrier_is_clear_of_the_names_of_wheels(width: float) -> None:
    """Whole boxes of letters, with what hangs below the line; a rim's name fits in its wheel."""
    results = shipped_results("wolfrom.yaml")
    figure = picture(results, "stick", Style(width=width / 25.4 * 72, wheels=True))
    assert {"carrier", "planet2: 21"} <= {text.get_text() for text in figure.texts}
    assert overlaps(figure) == []


@pytest.mark.parametrize("name", ["wilson-preselector", "zf-9hp48", "simpson-th400"])
def test_signs_are_seen_where_names_of_wheels_have_no_room(name: str) -> None:
    """In a column of 85 mm wheels have their teeth alone, or it is wider; lines can be printed."""
    results = shipped_results(f"{name}.yaml")
    style = Style("ru", wheels=True, width=85 / 25.4 * 72)
    figure = picture(results, "stick", style)
    assert overlaps(figure) == []
    drawing = drawing_of(results.case)
    assert drawing is not None
    teeth = {f"{n:g}" for one in drawing.elements for n in teeth_of(one).values()}
    assert len(teeth & {text.get_text() for text in figure.texts}) > 1
    widths = re.findall(rb'stroke-width="([\d.]+)', render(results, "stick", "svg", style))
    assert min(map(float, widths)) >= 0.1
    assert figure.get_figwidth() * 25.4 <= (85.1 if name != "simpson-th400" else 110)


def driveline() -> Transmission:
    """Shafts and a reduction before a set and behind it, longer than a page is wide."""
    names = ["crankshaft of the engine", "flywheel, secondary", "sun", "ring", "carrier"]
    names += [f"long name of shaft {n}" for n in range(1, 10)]
    ends = [(1, 2), (2, 3), *((n, n + 1) for n in range(5, 13))]
    sets = [Mechanism(3, 4, 5, -2), Mechanism(13, 14, 0, 3.1)]
    springs = [Spring(between(*both), stiffness=1, name=f"spring {both}") for both in ends]
    return Transmission(14, [ShiftElement(4)], sets, [Gear([1])], link_names=names, springs=springs)


def test_what_stands_before_a_box_and_behind_it_has_rows_of_its_own(browser: Any) -> None:
    results = vstatics.solve(driveline())
    [page] = measured(browser, [svg := render(results, "stick", "svg", Style(), [1])])
    assert (page.overlaps, page.outside, page.covered) == ([], [], [])
    assert page.width <= 170.01
    root = parsed(svg)
    drawn = [group.attrib["data-name"] for group in of_class(root, "mechanism")]
    devices = scheme_of(results.case).devices
    assert sorted(drawn) == sorted(one.name for one in devices if not one.is_shift_element)
    assert len(of_class(root, "axis")) == 1
    assert [one.get("data-port") for one in of_class(root, "port")] == ["input", "output"]
    said = [text for text, _ in page.letters]
    assert "goes on in another row" in said
    # what goes on is named at both ends
    assert said.count("sun") == said.count("carrier") == 2


def test_what_joins_three_links_of_one_axis_is_drawn() -> None:
    # the differential of an axle, one half-shaft of which has a brake
    axle = Drawing(3, [Element("axle", "bevel", {"left": 2, "right": 3, "carrier": 1}, {})])
    brake = [ShiftElement(3)]
    case = transmission(axle, shift_elements=brake, gears=[Gear([1])], input=1, output=2)
    root = svg_of(case)
    assert [one.attrib["data-name"] for one in of_class(root, "mechanism")] == ["axle"]
    assert set(wires(root)) == {"1", "2", "3"}


def test_sets_stand_in_the_order_of_the_case_on_demand() -> None:
    results = shipped_results("simpson-th400.yaml")
    figure = picture(results, "stick", Style(ordered=True))
    drawing = drawing_of(results.case)
    assert drawing is not None
    names = [one.name for one in drawing.elements]
    at = {text.get_text(): text.get_position()[0] for text in figure.texts}
    assert all(at[one] < at[other] for one, other in pairwise(names))


@each_seed(5, 100)
def test_random_boxes_keep_the_order_of_their_sets_or_say_why_not(seed: int) -> None:
    """By the places of the mechanisms in SVG; crossings are better than another order."""
    case = next_box(seeded(seed))
    figure = picture(vstatics.solve(case), "stick", Style(ordered=True))
    at = {text.get_text(): text.get_position()[0] for text in figure.texts}
    places = [at[one.name] for one in case.mechanisms]
    title = figure.texts[0].get_text()
    is_other = "sets in another order: no layout in that of the case was found" in title
    assert is_other == (places != sorted(places))
    assert not is_other


def test_planes_of_a_set_are_in_one_order() -> None:
    # sun 4 of the third plane is held, the input sun of the first and the output ring of the
    # third close the axis round it
    planes = Planes(3, [(1, 4), (0, 5), (2, 6)])
    assert not has_half_section(CoaxialTrain([planes], [(1, 2)], [3, 4, 2, 5], 1, 6))
    assert has_half_section(CoaxialTrain([planes], [(1, 2)], [3, 4, 5], 1, 6))


def test_all_outputs_have_their_arrow_and_differentials_are_named_as_sets() -> None:
    """Power leaves at each of four wheels; u = -1 is no set of a sun and a larger ring."""
    case = vstatics.loads(
        "links: [engine, front, rear, FL, FR, RL, RR]\noutputs: [FL, FR, RL, RR]\n"
        "elements: {centre: {kind: planetary, sun: front, ring: rear, carrier: engine,"
        " teeth: {sun: 40, ring: 60}}}\n"
        "mechanisms:\n  fore: {first: FL, second: FR, third: front, ratio: -1}\n"
        "  aft: {first: RL, second: RR, third: rear, ratio: -1}\n"
        "gears: {left: {speeds: {FR: 1.05*FL, RL: .98*FL, RR: 1.06*RL}}}\n"
    )
    outputs = [one.link for one in stick_scheme(case).ports if one.role == "output"]
    assert [case.link_name(link) for link in outputs] == ["FL", "FR", "RL", "RR"]
    figure = picture(vstatics.solve(case), "stick", Style())
    assert any("mechanisms as planetary sets" in text.get_text() for text in figure.texts)
