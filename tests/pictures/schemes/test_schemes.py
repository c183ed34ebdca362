"""Pictures of the scheme: everything that the case joins is joined, and can be read."""

from itertools import combinations
from pathlib import Path
from typing import Any

import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.text import Text

import vstatics
from tests.commands import CASES
from tests.pictures.drawn import texts
from tests.shipped import shipped_results
from vstatics import CaseError, Gear, Mechanism, Results, ShiftElement, Spring, Transmission, solve
from vstatics.core.elements import Drawing, Element, transmission
from vstatics.core.elements.drawing import drawing_of
from vstatics.core.elements.group import group_of
from vstatics.core.elements.kinds import KINDS, Simple
from vstatics.core.model.springs import between
from vstatics.pictures import picture, render
from vstatics.pictures.drawing.gear_state import state_of
from vstatics.pictures.drawing.style import Style
from vstatics.pictures.schemes.scheme import SchemeState, scheme_of, scheme_state
from vstatics.pictures.schemes.sets import section_of

PAIRS = """\
input: a
output: k
elements:
  pair: {kind: gear_pair, first: a, second: b, teeth: {first: 20, second: 41}}
  ring pair: {kind: internal_pair, first: b, second: c, teeth: {first: 20, second: 41}}
  idle: {kind: idler, first: c, second: d, teeth: {first: 20, idler: 25, second: 41}}
  chain 1: {kind: chain, first: d, second: e, teeth: {first: 41, second: 41}}
  belt 1: {kind: belt, first: e, second: f, diameters: {first: 100, second: 41}}
  bearing: {kind: shaft, first: f, second: g, efficiency: 0.99}
  steering: {kind: worm, worm: g, wheel: h, teeth: {worm: 2, wheel: 40},
             efficiency: {worm: 0.8, wheel: 0.7}}
  hypoid: {kind: bevel_pair, first: h, second: i, teeth: {first: 11, second: 40}}
  axle: {kind: bevel, carrier: i, left: left, right: right}
  stop: {kind: held, link: right}
mechanisms:
  extra: {first: left, second: k, ratio: 2}
shift_elements:
  lock: {kind: dog_clutch, links: [left, i]}
  way: {kind: freewheel, links: [j, a]}
  low and reverse brake: [j, housing]
gears:
  "1": {engaged: [low and reverse brake]}
"""


def overlaps(figure: Figure, rounded: float = 0.5) -> list[tuple[str, str]]:
    """Pairs of texts whose bounding boxes have a common area, and texts that leave the paper.

    Boxes may meet by `rounded` pixels.
    """
    canvas: Any = FigureCanvasAgg(figure)
    figure.draw_without_rendering()
    found: list[Any] = figure.findobj(Text)
    texts = [text for text in found if text.get_visible() and text.get_text().strip()]
    ink, whole = canvas.get_renderer(), figure.bbox
    boxes = [(text.get_text(), text.get_window_extent(ink)) for text in texts]
    assert boxes
    outside = [
        (name, "paper")
        for name, box in boxes
        if min(box.x0 - whole.x0, box.y0 - whole.y0, whole.x1 - box.x1, whole.y1 - box.y1) < 0
    ]
    return outside + [
        (one, other)
        for (one, a), (other, b) in combinations(boxes, 2)
        if min(min(a.x1, b.x1) - max(a.x0, b.x0), min(a.y1, b.y1) - max(a.y0, b.y0)) > rounded
    ]


@pytest.mark.slow
def test_pairs_of_every_kind_can_be_read_and_are_joined(tmp_path: Path) -> None:
    path = tmp_path / "pairs.yaml"
    path.write_text(PAIRS, "utf-8")
    results = vstatics.solve(vstatics.load(path))
    scheme = scheme_of(results.case)
    kinds = {device.kind for device in scheme.devices}
    assert kinds >= {name for name, kind in KINDS.items() if isinstance(kind, Simple)}
    shown = " ".join(text.get_text() for text in picture(results, "stick", Style()).texts)
    for device in scheme.devices:
        assert device.kind == "held" or device.name in " ".join(shown.split())


def test_stick_diagram_needs_elements() -> None:
    results = shipped_results("moskvich-start.yaml")  # springs alone
    with pytest.raises(CaseError, match="needs gear sets"):
        picture(results, "stick", Style())


def test_ravigneaux_set_has_its_small_sun_at_the_short_planets() -> None:
    # docs/elements.md: small sun with short, large sun and ring with long, short with long
    case = vstatics.load(CASES / "ravigneaux-aod.yaml")
    drawing = drawing_of(case)
    assert drawing is not None
    section = section_of(group_of(drawing.elements[0]))
    planes = {
        column.sun.member: (column.rims, column.ring and column.ring.member)
        for column in section.columns
        if column.sun is not None
    }
    assert planes["small_sun"] == ({0: "short", 1: "long"}, "ring")
    assert planes["large_sun"] == ({1: "long"}, None)


def test_each_wheel_of_the_umdm_is_in_the_plane_of_its_rim() -> None:
    # the meshes of cases/umdm.yaml
    drawing = drawing_of(vstatics.load(CASES / "umdm.yaml"))
    assert drawing is not None
    section = section_of(group_of(drawing.elements[0]))
    seen = set()
    for column in section.columns:
        if column.sun is not None:
            seen.add((column.sun.member, column.rims[min(column.rims)]))
        if column.ring is not None:
            seen.add((column.ring.member, column.rims[max(column.rims)]))
    suns, rings = {("sun 1", "A2"), ("sun 4", "B3'")}, {("ring 6", "A2"), ("ring 7", "B3")}
    assert seen == suns | rings | {("ring 8", "B3'")}
    assert {0: "A2'", 1: "B3"} in [column.rims for column in section.columns]


@pytest.mark.parametrize("kind", ["structure", "stick"])
def test_third_gear_of_the_eight_speed_marks_its_three_elements(kind: str) -> None:
    # shift table of the ZF 8HP: gear 3 has B, C and E; A and D are open
    style = Style()
    figure = picture(shipped_results("zf-8hp70.yaml"), kind, style, [3])
    colors = {text.get_text(): text.get_color() for text in figure.texts}
    assert {name for name, color in colors.items() if color == style.engaged} == {"B", "C", "E"}
    assert colors["A"] == colors["D"] == style.soft
    # carrier 3 goes to the open clutch D alone, so P3 carries nothing
    assert colors["carrier 3"] == style.soft
    assert colors["P1"] == colors["P4"] == colors["output"] == style.ink


def states(results: Results, *gears: int) -> tuple[dict[str, int], list[SchemeState]]:
    """The components of a scheme by their names, and its states in gears."""
    scheme = scheme_of(results.case)
    named = {device.name: index for index, device in enumerate(scheme.devices)}
    return named, [scheme_state(scheme, state_of(results, gear)) for gear in gears]


@pytest.mark.parametrize(("slip", "said"), [(0.5, "slips under torque"), (0.0, "engaged")])
def test_a_clutch_that_slips_is_not_marked_as_engaged(slip: float, said: str) -> None:
    clutch, gear = ShiftElement(1, 2, name="C"), Gear(name="troll", slip={1: slip})
    case = Transmission(3, [clutch], [Mechanism(2, 3, 0, -2.0)], [gear])
    figure = picture(vstatics.solve(case), "structure", Style(), [1])
    assert {"slips under torque", "engaged"} & set(texts(figure)) == {said}


def test_freewheel_is_marked_where_it_holds() -> None:
    # the low roller clutch of the TH400 holds in drive, first gear, and overruns in second
    named, (first, second) = states(shipped_results("simpson-th400.yaml"), 1, 2)
    assert named["low roller clutch"] in first.engaged
    assert named["low roller clutch"] in second.idle


def test_support_that_holds_is_not_pale() -> None:
    # cases/wheel-hub.yaml: in gear `both` the right wheel carries torque by the right hub, whose
    # ring the support holds; in gear `left` it hangs in the air
    results = shipped_results("wheel-hub.yaml")
    named, (left, both) = states(results, 1, 3)
    wheel = results.case.link_names.index("right wheel") + 1
    assert named["support"] in left.idle
    assert named["support"] not in both.idle
    assert wheel in {port.link for port in left.idle_ports}
    assert wheel not in {port.link for port in both.idle_ports}


def test_gear_that_is_tied_up_says_so() -> None:
    # two brakes hold sun and ring of a set whose sun is driven
    brakes, gears = [ShiftElement(1), ShiftElement(2)], [Gear([1, 2]), Gear([])]
    results = vstatics.solve(Transmission(3, brakes, [Mechanism(1, 2, 3, -2)], gears))
    for gear, state in ((1, "tied up"), (2, "not determined")):
        title = picture(results, "structure", Style(), [gear]).texts[0].get_text()
        assert title == f"Structure, gear {gear}, {state}"


def test_a_set_that_reacts_as_one_piece_is_marked_and_not_pale() -> None:
    # issue 16: Ford 10R80, gear 1: P1 stands between its brakes and carries 3.696 of the input
    # torque; P2 and P3 carry none
    results = shipped_results("ford-10r80.yaml")
    named, [state] = states(results, 1)
    assert state.pieces == {named["P1"]}
    assert {named["P2"], named["P3"]} < state.idle
    assert not {named["P1"], named["P4"]} & state.idle
    svg = render(results, "stick", "svg", Style(), [1]).decode()
    assert "carrier −3.696" in svg
    assert "rotates as a block" in svg


def test_ports_show_which_way_their_power_goes() -> None:
    # cases/power-split.yaml: MG1 and the right wheel take power (`vstatics flow`)
    results = shipped_results("power-split.yaml")
    scheme = scheme_of(results.case)
    ways = scheme_state(scheme, state_of(results, 1)).leaving
    found = {scheme.name(port.link): leaves for port, leaves in ways.items()}
    taking = dict.fromkeys(("MG1", "left wheel", "right wheel"), True)
    assert found == {"engine": False, "MG2": False} | taking


def test_wheels_have_their_names_and_teeth_on_request() -> None:
    # cases/wheel-hub.yaml
    results = shipped_results("wheel-hub.yaml")
    bare, full = (picture(results, "stick", Style(wheels=wheels)) for wheels in (False, True))
    assert {*texts(full)} - {*texts(bare)} == {"sun: 26", "ring: 64"}
    at = {text.get_text(): text.get_position()[1] for text in full.texts}
    assert at["sun: 26"] < at["ring: 64"]


def test_mechanisms_that_may_be_sets_have_a_stick_diagram_with_a_note() -> None:
    said = texts(picture(shipped_results("mzkt7922.dat"), "stick", Style()))
    assert any("as planetary sets" in text for text in said)
    assert {"D1", "D2", "D3"} < set(said)


def ring(count: int) -> Transmission:
    """A ring of sets: set n shares a link with the next, the last with the first."""
    sets = [Mechanism(n, n % count + 1, count + n, -2 - n / 50) for n in range(1, count + 1)]
    brakes = [ShiftElement(count + n) for n in range(1, count + 1)]
    return Transmission(2 * count, brakes, sets, [Gear(range(1, count))])


def test_a_case_that_no_picture_could_show_is_refused() -> None:
    with pytest.raises(CaseError, match=r"up to 200 .* has 202"):
        scheme_of(ring(101))


SPRINGS = [
    Spring(between(1, 2), stiffness=1, name="damper"),
    Spring(between(4), stiffness=1, name="mount"),
    Spring({3: 1, 4: -4.1, 5: 3.1}, stiffness=1, name="axle"),
]
ELEMENTS = [ShiftElement(2, 3, "C"), ShiftElement(3, 0, "B")]
GEARS = [Gear([1], name="on"), Gear([2], name="off")]
CASE = Transmission(5, ELEMENTS, [], GEARS, springs=SPRINGS)


def test_a_shaft_is_a_coupling_and_any_other_a_box_with_its_coefficients() -> None:
    scheme = scheme_of(CASE)
    shown = [(one.name, one.kind, one.members, one.is_coupling) for one in scheme.devices[2:]]
    assert shown == [
        ("damper", "spring", {"first": 1, "second": 2}, True),
        ("mount", "spring", {"first": 4, "second": 0}, True),
        ("axle", "spring", {"3": 3, "4": 4, "5": 5}, False),
    ]
    assert [one.is_on_housing for one in scheme.devices[2:]] == [False, True, False]
    assert scheme.devices[4].labels == {"3": "×1", "4": "×-4.1", "5": "×3.1"}
    loaded, idle = (
        {device.name for place, device in enumerate(scheme.devices) if place not in state.idle}
        for state in (scheme_state(scheme, state_of(solve(CASE), n)) for n in (1, 2))
    )
    assert {"damper", "mount", "axle", "C"} <= loaded
    assert idle == {"damper", "mount", "axle", "B"}  # the input stands: no torque is known


def test_springs_can_be_read_in_the_structure() -> None:
    for gears in ((), (1,), (2,)):
        figure = picture(solve(CASE), "structure", Style(), gears)
        shown = {"damper", "mount", "axle", "spring", "×−4.1", "×3.1", "×1"}
        assert shown <= {*texts(figure)}
        assert overlaps(figure) == []


def test_springs_stand_beside_drawn_elements() -> None:
    pair = Element("G", "gear_pair", {"first": 1, "second": 2}, {"first": 20, "second": 41})
    springs = [Spring(between(2, 3), stiffness=1, name="half"), SPRINGS[1]._replace(twist={3: 2})]
    for count, shown in ((1, {"half"}), (2, {"half", "mount", "×2"})):
        case = transmission(Drawing(3, [pair]), gears=[Gear()], springs=springs[:count])
        figure = picture(solve(case), "stick", Style())
        assert shown <= {*texts(figure)}
        assert count > 1 or overlaps(figure) == []


def test_one_mass_on_a_spring_is_drawn() -> None:
    case = Transmission(1, [], [], [], springs=[Spring(between(1), stiffness=3, name="s")])
    figure = picture(solve(case), "structure", Style("ru"))
    assert {*texts(figure)} == {"Структура", "1", "s"}
    boxed = case.replace(springs=[Spring({1: 2.0}, stiffness=3, name="s")])
    assert "пружина" in texts(picture(solve(boxed), "structure", Style("ru")))


def test_a_shaft_and_a_mechanism_have_one_state() -> None:
    """In the lever both ends of a shaft are joined to the input."""
    shaft = Spring(between(1, 2), stiffness=1)
    case = Transmission(4, [ShiftElement(3)], [Mechanism(2, 3, 4, -2.0)], [Gear([1])])
    case = case.replace(springs=[shaft])
    assert state_of(solve(case), 1).joined == [0, 1, 1, 0, 4]
