"""Levers: positions follow from the teeth, speeds are linear along them."""

from collections.abc import Iterator
from itertools import combinations, pairwise
from typing import Any

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Polygon
from matplotlib.path import Path
from matplotlib.text import Text

from tests.chance import some
from tests.commands import CASES, SHIPPED, vstatics
from tests.pictures.drawn import texts
from tests.pictures.schemes.test_schemes import overlaps as overlaps_of
from tests.pictures.test_pictures import overlaps
from tests.shipped import shipped_results
from vstatics import loads, solve
from vstatics.pictures import picture, render
from vstatics.pictures.drawing.files import figures_of, settings_of
from vstatics.pictures.drawing.labels import Segment
from vstatics.pictures.drawing.style import Style
from vstatics.pictures.lever.gear import in_gear
from vstatics.pictures.lever.joined import LeverRoute, routes
from vstatics.pictures.lever.order import ordered
from vstatics.pictures.lever.picture import each
from vstatics.pictures.lever.places import LeverPage, page_of
from vstatics.pictures.lever.points import levers, shafts

NAMES = [path.name for path in SHIPPED]
DRAWN = [name for name in NAMES if name != "moskvich-start.yaml"]
"""The other one has no set."""
QUICK = ("mercedes-7g.yaml", "mzkt7922.dat", "ravigneaux-aod.yaml", "umdm.yaml", "zf-8hp70.yaml")
MOSTLY_SLOW = [pytest.param(name, marks=[pytest.mark.slow] * (name not in QUICK)) for name in DRAWN]


def test_positions_on_a_lever_follow_from_the_teeth() -> None:
    """Ravigneaux of 30, 36 and 72 teeth against its carrier: 72/30 : -72/36 : 1."""
    results = shipped_results("ravigneaux-aod.yaml")
    [lever] = levers(results.case)
    positions = {results.case.link_name(node.link): node.position for node in lever.nodes}
    expected = {"reverse sun": -2, "carrier": 0, "ring": 1, "forward sun": 2.4}
    assert positions == pytest.approx(expected)


def test_the_mark_of_an_output_stands_over_that_of_a_point_at_the_same_place() -> None:
    """The second ring of a Wolfrom set turns once in 400 turns of the sun: nearly as the first."""
    for name, count in (("wolfrom.yaml", 1), ("ravigneaux-aod.yaml", 0)):
        marks = picture(shipped_results(name), "lever", Style()).findobj(Polygon)
        over = [one for one in marks if to_hex(one.get_edgecolor()) == Style().paper]
        assert len(over) == count
        assert all(len({*map(tuple, one.get_xy())}) == 4 for one in over)  # a diamond


@pytest.mark.parametrize("name", NAMES)
def test_speeds_are_linear_along_every_lever(name: str) -> None:
    """Willis: all speeds against the carrier are in the ratio of their positions."""
    results = shipped_results(name)
    speeds = np.hstack([np.zeros((len(results.case.gears), 1)), results.speeds])
    for lever in levers(results.case):
        low, high = lever.nodes[0], lever.nodes[-1]
        slope = (speeds[:, high.link] - speeds[:, low.link]) / (high.position - low.position)
        for node in lever.nodes:
            expected = speeds[:, low.link] + slope * (node.position - low.position)
            np.testing.assert_allclose(speeds[:, node.link], expected, atol=1e-9)


@pytest.mark.parametrize("name", ["zf-8hp70.yaml", "ravigneaux-aod.yaml", "mzkt7922.dat"])
@pytest.mark.parametrize("merged", [False, True])
def test_torques_on_a_lever_are_in_balance_like_forces(name: str, merged: bool) -> None:
    """Benford and Leising 1981: neither their sum nor their moment moves the lever."""
    results = shipped_results(name)
    drawn = levers(results.case, merged=merged)
    for number in range(1, len(results.case.gears) + 1):
        for lever, torques in zip(drawn, in_gear(results, number, drawn).torques, strict=True):
            moment = np.dot(torques, [node.position for node in lever.nodes])
            assert [sum(torques), moment] == pytest.approx([0, 0], abs=1e-9)


def test_two_sets_with_two_common_links_are_one_lever() -> None:
    """Simpson of 3HP 22, ratios -u: sun, carrier 2, output (carrier 1 and ring 2), ring 1.

    From carrier 1 the ring is at 1, the sun at u1. Carrier 2 divides sun to ring 2 as 1 to -u2.
    """
    case = shipped_results("simpson.yaml").case
    first, second = (one.ratio for one in case.mechanisms)
    [lever] = levers(case, merged=True)
    positions = {case.link_name(node.link): node.position for node in lever.nodes}
    carrier = first / (1 - second)
    expected = {"sun": first, "carrier 2": carrier, "output": 0, "ring 1": 1}
    assert positions == pytest.approx(expected)
    assert len(levers(case)) == 2


def test_a_link_that_a_locked_set_holds_stands() -> None:
    """Issue 16: ZF 8HP70, gears 1, 2, R: A and B hold sun and ring of P1, so its carrier stands.

    In gear 1 A, B and C are engaged; two of them are brakes.
    """
    results = shipped_results("zf-8hp70.yaml")
    drawn = levers(results.case)
    gears = [in_gear(results, number, drawn) for number in range(1, 10)]
    [carrier] = [n for n in range(1, 9) if results.case.link_name(n) == "carrier 1"]
    names = [gear.name for gear in results.case.gears]
    held = [name for name, gear in zip(names, gears, strict=True) if gear.stands(carrier)]
    assert held == ["1", "2", "R"]
    assert sorted(gears[0].grounds.values()) == [["A"], ["B"]]
    assert [one.name for one in gears[0].ties if one.name] == ["C"]


def drawn_text(name: str, *gears: int) -> str:
    return render(shipped_results(name), "lever", "svg", Style(), gears).decode()


def test_a_set_that_is_locked_and_carries_the_reaction_is_one_piece() -> None:
    """Issue 16: Ford 10R80, gear 1: P1 takes 3.696 of the input torque; P2 and P3 take none."""
    drawn = drawn_text("ford-10r80.yaml", 1)
    assert "P1, locked up" in drawn
    assert "<title>P1 carrier: carrier 1, speed 0.000, torque −3.696</title>" in drawn
    assert "P2, locked up" not in drawn
    assert "carries no torque" in drawn


def test_a_clutch_that_is_engaged_without_torque_says_so() -> None:
    # Ford 10R80: in gear 1 D joins the intermediate shaft, on which nothing acts, to sun 4
    # (M_D = 0 by the balance of the intermediate shaft); in gear 2 P4 is driven through it
    whole = shipped_results("ford-10r80.yaml")
    slack = [in_gear(whole, number, levers(whole.case)).is_slack("D") for number in (1, 2)]
    assert slack == [True, False]
    said = "engaged, without torque"
    assert [said in drawn_text("ford-10r80.yaml", number) for number in (1, 2)] == slack


@pytest.mark.slow
def test_a_lever_that_shows_the_same_refers_to_the_gear_before() -> None:
    """BelAZ-7516: T1 makes the odd gears with P1, T2 the even ones (its table of gears)."""
    drawn = drawn_text("belaz7516.yaml")
    assert [drawn.count(f"P1, as in gear {gear}<") for gear in (1, 2, 3)] == [3, 3, 0]


@pytest.mark.slow
@pytest.mark.parametrize("name", some(DRAWN))
def test_no_text_or_line_covers_a_text_of_merged_levers(name: str) -> None:
    """Names of ties are texts as others; only names of brakes have paper around their letters."""
    style = Style("ru", merged=True)
    results = shipped_results(name)
    assert overlaps(results, "lever", style) == []
    gears = [(n,) for n in range(1, len(results.case.gears) + 1)]
    for pages in each(results, Style(), gears):
        [figure] = figures_of(pages)
        assert list(crossed(figure)) == []


def test_a_wheel_that_is_part_of_the_axle_is_held_by_the_housing() -> None:
    """The hubs' rings are fixed, one by the housing as its link, one by a support (the case)."""
    results = shipped_results("wheel-hub.yaml")
    drawn = levers(results.case)
    held = in_gear(results, 3, drawn).grounds
    assert [drawn[place].name for place, _ in held] == ["left hub", "right hub"]
    assert [*held.values()] == [[], []]


def test_the_key_tells_what_occurs_and_nothing_else() -> None:
    """Tarasik's set: its brake in gear 1, its clutch in gear 2 (the case).

    TH400: the low roller clutch holds in gear 1, the rear band in R (its table of gears).
    """
    keys = [drawn_text("tarasik-set.yaml", gear) for gear in (1, 2)]
    assert ["held by a brake" in key for key in keys] == [True, False]
    assert [">clutch<" in key for key in keys] == [False, True]
    keys = [drawn_text("simpson-th400.yaml", gear) for gear in (1, 4)]
    assert ["freewheel that holds" in key for key in keys] == [True, False]
    assert ["held by a brake" in key for key in keys] == [False, True]


def crossed(figure: Figure) -> Iterator[str]:
    """Texts of a figure that a line runs through, by more than their margins."""
    canvas: Any = FigureCanvasAgg(figure)
    renderer = canvas.get_renderer()
    ends: list[Any] = []
    for line in figure.findobj(Line2D):
        if isinstance(line, Line2D) and line.get_linestyle() != "None":
            places = line.get_transform().transform(line.get_xydata())
            ends += [one for one in pairwise(places) if np.isfinite(one).all()]
    for text in figure.findobj(Text):
        if isinstance(text, Text) and text.get_text() and not text.get_path_effects():
            box = text.get_window_extent(renderer).padded(-1, -2)
            if any(Path(np.array(one)).intersects_bbox(box, filled=False) for one in ends):
                yield text.get_text()


@pytest.mark.parametrize("name", MOSTLY_SLOW)
def test_points_stand_at_their_ratios(name: str) -> None:
    for cell in page(name).cells:
        if cell.lever.ratio is None and len(cell.rows) > 2:
            (low, first), *others, (high, last) = sorted(cell.rows.items())
            places = [node.position for node in cell.lever.nodes]
            scale = (last.at - first.at) / (places[high] - places[low])
            for node, row in others:
                expected = first.at + scale * (places[node] - places[low])
                assert row.at == pytest.approx(expected, abs=1e-9)


def page(name: str) -> LeverPage:
    found = page_of(shipped_results(name).case, Style())
    assert found is not None
    return found


def routes_of(name: str) -> Iterator[list[LeverRoute]]:
    """The lines between levers in each gear."""
    results, drawn = shipped_results(name), page(name)
    for number in range(1, len(results.case.gears) + 1):
        yield routes(drawn, in_gear(results, number, drawn.levers).ties)


@pytest.mark.parametrize("name", MOSTLY_SLOW)
def test_what_rises_between_levers_has_a_place_of_its_own(name: str) -> None:
    for found in routes_of(name):
        pieces = [piece for route in found for piece in route.pieces]
        lines = [(n, line) for n, points in pieces for line in pairwise(points)]
        upright = [(n, round(x, 6)) for n, ((x, y), end) in lines if x == end[0] and y != end[1]]
        assert len(set(upright)) == len(upright)


@pytest.mark.parametrize("name", ["gm-thm440.yaml", "mercedes-5g.yaml", "mercedes-7g.yaml"])
def test_levers_are_turned_over_where_no_line_crosses_then(name: str) -> None:
    """Counted from the places of all lines; as the levers of these boxes come, they cross."""
    for found in routes_of(name):
        lines = [
            (route.tie, band, line)
            for route in found
            for band, points in route.pieces
            for line in pairwise(points)
        ]
        for (tie, band, one), (other_tie, other_band, other) in combinations(lines, 2):
            assert tie == other_tie or band != other_band or not meet(one, other)


def meet(one: Segment, other: Segment) -> bool:
    """Whether an upright line runs through a level one, not only to it."""
    for (start, end), (left, right) in ((one, other), (other, one)):
        low, high = sorted((start[1], end[1]))
        is_across = left[1] == right[1] and left[0] < start[0] < right[0]
        if start[0] == end[0] and is_across and low < left[1] < high:
            return True
    return False


def test_the_ratio_is_the_largest_text() -> None:
    results = shipped_results("zf-8hp70.yaml")
    for is_titled in (True, False):
        figure = picture(results, "lever", Style(titled=is_titled), [3])
        found: list[Any] = figure.findobj(Text)
        largest = max(found, key=lambda text: text.get_fontsize())
        assert largest.get_text() == f"i = {results.ratio[2]:.3f}"


def test_speeds_are_drawn_to_one_scale_from_where_a_link_stands() -> None:
    """Tarasik's set in gear 1: its output turns at 1/2.5 of its input (the case)."""
    figure = picture(shipped_results("tarasik-set.yaml"), "lever", Style(), [1])
    lines: list[Any] = figure.findobj(Line2D)
    bars = [line.get_xdata()[:2] for line in lines if line.get_linewidth() == 3.2]
    (start, end), (other, shorter) = sorted(bars, key=lambda bar: -bar[1])
    assert (other, shorter - start) == pytest.approx((start, (end - start) / 2.5))
    assert 0 < start < end


def test_levers_of_a_gear_go_on_in_the_next_row() -> None:
    """8HP70 on 170 mm: a line that is cut goes on as high as it ends, in the next row."""
    assert page("zf-8hp70.yaml").bands == [[0, 1], [2, 3]]
    third = list(routes_of("zf-8hp70.yaml"))[2]
    cut = [route for route in third if len(route.pieces) > 1]
    assert len(cut) == 3  # ring 2, carrier 1, and C from the input to ring 3
    for route in cut:
        for (band, points), (after, following) in pairwise(route.pieces):
            assert (after, following[0][1]) == (band + 1, points[-1][1])


@pytest.mark.slow
def test_options_of_levers_and_of_stick_diagrams_serve_no_other_kind() -> None:
    asked = ("plot", CASES / "simpson.yaml", "-o", "-", "-k")
    assert "P1 + P2" in vstatics(*asked, "lever", "--merge").out
    for option, why in (("merge", "only levers can be merged"), ("teeth", "only stick diagrams")):
        assert vstatics(*asked, "plan", f"--{option}").is_wrong_use(f"--{option}: {why}")


@pytest.mark.slow
def test_long_titles_and_names_of_levers_stay_inside_the_figure() -> None:
    """Bold letters are wider, Cyrillic ones more so (issue 16)."""
    name = "Трёхступенчатая коробка для проверки вёрстки"
    results = solve(shipped_results("simpson.yaml").case.replace(name=name))
    style = Style("ru", merged=True)
    with settings_of(style):
        figure = picture(results, "lever", style, [3])
        assert overlaps_of(figure) == []
    names = [one.get_text().replace("\n", " ") for one in figure.findobj(Text)]
    assert "P1 + P2, блокировано" in names


def test_a_long_name_of_a_brake_is_cut_before_the_speed() -> None:
    case = shipped_results("ravigneaux-gf4a.yaml").case
    for name in ("low and reverse brake", "brake of a name that is longer than the lever is wide"):
        brakes = [
            one._replace(name=name) if one.name == "low and reverse brake" else one
            for one in case.shift_elements
        ]
        reverse = len(case.gears)
        figure = picture(solve(case.replace(shift_elements=brakes)), "lever", Style(), [reverse])
        shown = [one for one in texts(figure) if one.startswith(name[:12]) and "," not in one]
        assert overlaps_of(figure) == []
        assert [one == name for one in shown] == [name.startswith("low")]


def test_the_input_stands_left_of_the_output_and_joints_are_short() -> None:
    """8HP70: P1 to P4 as in every drawing of it; its driveline begins with the engine."""
    case = shipped_results("zf-8hp70.yaml").case
    assert [lever.name for lever in ordered(case, levers(case))] == ["P1", "P2", "P3", "P4"]
    driveline = shipped_results("driveline-8hp70.yaml").case
    drawn = levers(driveline)
    first, *_, last = ordered(driveline, [*drawn, *shafts(driveline, drawn)])
    ends = [driveline.link_name(lever.nodes[0].link) for lever in (first, last)]
    assert ends == ["engine", "vehicle"]


TWO_CLUTCHES = """\
links: [engine, primary, secondary, sun, ring, carrier, out]
shift_elements: {KL: [engine, primary], KH: [engine, carrier]}
mechanisms:
  var: {kind: variator, first: primary, second: secondary, speed_ratio: 1.25}
  red: {first: secondary, second: sun, ratio: 1.6}
elements:
  P: {kind: planetary, sun: sun, ring: ring, carrier: carrier, teeth: {sun: 30, ring: 70}}
  fin: {kind: gear_pair, first: ring, second: out, teeth: {first: 20, second: 61}}
gears:
  split: {engaged: [KL, KH]}
"""


def test_no_line_runs_through_the_sign_of_a_clutch() -> None:
    """Two clutches on one link are side by side: the line of each branches off before plates."""
    split = solve(loads(TWO_CLUTCHES))
    [power_split] = each(split, Style(), [[1]])
    assert any("x = 1.250" in text for text in power_split[0].texts)
    own = page_of(split.case, Style())
    assert own is not None
    pictures = [routes(own, in_gear(split, 1, own.levers).ties)]
    for name in ("zf-8hp70.yaml", "mercedes-7g.yaml", "simpson.yaml"):
        pictures += routes_of(name)
    for found in pictures:
        for one in (route for route in found if route.sign is not None):
            assert one.sign is not None
            band, (x, y) = one.sign
            others = [route for route in found if route is not one]
            for at, points in (piece for route in others for piece in route.pieces):
                for (start, low), (end, high) in pairwise(points):
                    assert at != band or low != high or abs(low - y) > 1 or not start < x < end
