"""Pictures of transmissions: what they show is true, and no label covers another.

The rays of the UMDM follow from its plan (Voloshko, Galimyanov, Salakhov, Mavleev, Kinematic
and force analysis of the universal multi-flow differential mechanism, figure 5): all meet at
(1, 1), so a link that is stopped in the gear of ratio u has the ray (u*x - 1)/(u - 1). The
ratios are those of the teeth in `cases/umdm.yaml` by its equations (5) to (8).
"""

from __future__ import annotations

import importlib.util
import subprocess
import sys
from importlib import import_module
from itertools import combinations, pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.commands import CASES, LOCKED, NEUTRAL, TIED_UP, vstatics
from vstatics import CaseError, Gear, Mechanism, Results, ShiftElement, Transmission, load, solve
from vstatics.pictures import FORMATS, PICTURES, Format, picture, render
from vstatics.pictures.efficiency import loss_shares
from vstatics.pictures.labels import spread
from vstatics.pictures.lever import levers
from vstatics.pictures.rays import KinematicPlan, plans
from vstatics.pictures.style import Style

SHIPPED = sorted(path.name for path in CASES.iterdir())
QUICK = ("mzkt7922.dat", "power-split.yaml")
WITHOUT_PLAN = ("wheel-hub.yaml", "wolfrom.yaml")
"""One degree of freedom, and nothing that shifts."""


def result(name: str) -> Results:
    return solve(load(CASES / name))


@pytest.fixture(scope="module")
def umdm() -> Results:
    return result("umdm.yaml")


def links(results: Results, numbers: tuple[int, ...]) -> str:
    return " = ".join(results.case.link_name(link) for link in numbers)


RATIOS = {"sun 4": 1147 / 756, "carrier": 37 / 14, "ring 6": 111 / 65, "ring 7": -37 / 9}
"""u of each gear of the UMDM, in which this link is held: sun 1 in, ring 8 out."""


@pytest.mark.parametrize(("link", "u"), RATIOS.items())
def test_rays_of_the_umdm_follow_from_its_ratios(umdm: Results, link: str, u: float) -> None:
    """Zero 1/u, ordinate -1/(u - 1) at the origin and slope u/(u - 1)."""
    [plan] = plans(umdm)
    rays = {links(umdm, ray.links): ray for ray in plan.rays}
    ray = rays[link]
    expected = 1 / u, -1 / (u - 1), u / (u - 1)
    assert (-ray.start / ray.slope, ray.start, ray.slope) == pytest.approx(expected)


def test_the_input_is_horizontal_and_the_output_the_bisector(umdm: Results) -> None:
    [plan] = plans(umdm)
    rays = {links(umdm, ray.links): ray for ray in plan.rays}
    assert (rays["sun 1"].start, rays["sun 1"].slope) == pytest.approx((1, 0))
    assert (rays["ring 8"].start, rays["ring 8"].slope) == pytest.approx((0, 1))


def test_all_rays_of_the_umdm_meet_in_the_unit_point(umdm: Results) -> None:
    [plan] = plans(umdm)
    assert plan.has_unit_point
    assert [ray.at(1.0) for ray in plan.rays] == pytest.approx([1.0] * 6)


def test_gears_stand_at_the_inverse_of_their_ratios(umdm: Results) -> None:
    [plan] = plans(umdm)
    ratios = [37 / 14, 111 / 65, 1147 / 756, 1, -37 / 9]
    assert [1 / mark.output for mark in plan.marks] == pytest.approx(ratios)


def drawn_lines(results: Results) -> list[Any]:
    [axes] = picture(results, "plan", Style()).axes
    return list(axes.get_lines())


@pytest.mark.parametrize("u", RATIOS.values(), ids=RATIOS)
def test_the_picture_draws_these_rays(umdm: Results, u: float) -> None:
    """Slope and zero of a line of the picture, from the coordinates of its ends."""
    zero, slope = 1 / u, u / (u - 1)
    found = []
    for line in drawn_lines(umdm):
        (x0, x1), (y0, y1) = (np.ravel(values)[[0, -1]] for values in line.get_data())
        if x1 > x0:
            found.append(
                (x0 - y0 * (x1 - x0) / (y1 - y0) if y1 != y0 else np.nan, (y1 - y0) / (x1 - x0))
            )
    assert any(one == pytest.approx((zero, slope), abs=1e-6) for one in found)


def test_the_picture_has_a_vertical_for_each_gear(umdm: Results) -> None:
    upright = {line.get_xdata()[0] for line in drawn_lines(umdm) if line.get_linestyle() == "--"}
    expected = [-9 / 37, 14 / 37, 65 / 111, 756 / 1147, 1]
    assert sorted(upright) == pytest.approx(expected)


@pytest.mark.parametrize("name", [name for name in SHIPPED if name not in WITHOUT_PLAN])
def test_speeds_on_a_vertical_are_those_of_its_gear(name: str) -> None:
    results = result(name)
    for plan in plans(results):
        assert_speeds_on_rays(results, plan)


def assert_speeds_on_rays(results: Results, plan: KinematicPlan) -> None:
    for mark in plan.marks:
        speeds = results.speeds[mark.gear - 1]
        for ray in plan.rays:
            for link in ray.links:
                if np.isfinite(speeds[link - 1]):
                    assert ray.at(mark.output) == pytest.approx(speeds[link - 1], abs=1e-9)


def test_three_degrees_of_freedom_have_a_plan_for_each_element() -> None:
    """MZKT 7922: elements 1 to 5 are in gears 1 3, 2 4, 5 6, 1 2 5 and 3 4 6 of the deck."""
    found = {
        plan.engaged: [mark.gear for mark in plan.marks] for plan in plans(result("mzkt7922.dat"))
    }
    assert found == {
        ("T1",): [1, 3],
        ("F2",): [2, 4],
        ("T3",): [5, 6],
        ("T4",): [1, 2, 5],
        ("F5",): [3, 4, 6],
    }


def test_only_a_plan_without_brakes_has_a_unit_point() -> None:
    """A train that turns as one piece moves a brake's link."""
    has = {plan.engaged: plan.has_unit_point for plan in plans(result("mzkt7922.dat"))}
    assert has == {("T1",): False, ("F2",): True, ("T3",): False, ("T4",): False, ("F5",): True}


def test_four_degrees_of_freedom_have_a_plan_for_two_elements_in_common() -> None:
    """ZF 8HP: of its ten pairs of elements each is in two gears or three of the shift table."""
    results = result("zf-8hp70.yaml")
    names = [gear.name for gear in results.case.gears]
    found = {plan.engaged: {names[mark.gear - 1] for mark in plan.marks} for plan in plans(results)}
    assert len(found) == 10
    assert found["A", "B"] == {"1", "2", "R"}
    assert found["C", "E"] == {"3", "6"}


def test_without_a_free_speed_there_is_no_plan() -> None:
    for name in WITHOUT_PLAN:
        with pytest.raises(CaseError, match="no gear of this case leaves anything free"):
            plans(result(name))


def test_a_freewheel_that_holds_makes_a_gear_like_a_brake() -> None:
    """The ring wants to turn backward; held, it leaves the carrier 1/(1 + 2.5) of the sun."""
    case = Transmission(
        3,
        [ShiftElement(2, 0, kind="freewheel"), ShiftElement(3, 1)],
        [Mechanism(1, 2, 3, -2.5)],
        [Gear(), Gear([2])],
    )
    [plan] = plans(solve(case))
    assert [mark.output for mark in plan.marks] == pytest.approx([1 / 3.5, 1])
    assert [mark.elements for mark in plan.marks] == [(1,), (2,)]


def test_positions_on_a_lever_follow_from_the_teeth() -> None:
    """Ravigneaux of 30, 36 and 72 teeth against its carrier: 72/30 : -72/36 : 1."""
    results = result("ravigneaux-aod.yaml")
    [lever] = levers(results.case)
    positions = {results.case.link_name(node.link): node.position for node in lever.nodes}
    assert positions == pytest.approx(
        {"reverse sun": -2, "carrier": 0, "ring": 1, "forward sun": 2.4}
    )


@pytest.mark.parametrize("name", SHIPPED)
def test_speeds_are_linear_along_every_lever(name: str) -> None:
    """Willis: all speeds against the carrier are in the ratio of their positions."""
    results = result(name)
    speeds = np.hstack([np.zeros((len(results.case.gears), 1)), results.speeds])
    for lever in levers(results.case):
        low, high = lever.nodes[0], lever.nodes[-1]
        slope = (speeds[:, high.link] - speeds[:, low.link]) / (high.position - low.position)
        for node in lever.nodes:
            expected = speeds[:, low.link] + slope * (node.position - low.position)
            np.testing.assert_allclose(speeds[:, node.link], expected, atol=1e-9)


def test_shares_of_losses_make_up_what_the_efficiency_lacks() -> None:
    for name in ("umdm.yaml", "zf-8hp70.yaml", "two-stage.yaml", "mzkt7922.dat"):
        for coast in (False, True):
            results = solve(load(CASES / name), coast=coast)
            _, shares = loss_shares(results, Style())
            kept = ~np.isnan(results.efficiency)
            np.testing.assert_allclose(1 - shares.sum(axis=0)[kept], results.efficiency[kept])
            assert (shares[:, kept] >= -1e-12).all()


def test_labels_move_as_little_as_they_can() -> None:
    """Two labels of size 2 wanted at one place go one to each side; a third, far off, stays."""
    assert spread([4, 4, 20], [2, 2, 2]) == pytest.approx([3, 5, 20])
    assert spread([0, 0], [2, 2], low=0, high=10) == pytest.approx([1, 3])
    assert spread([10, 10], [2, 2], low=0, high=10) == pytest.approx([7, 9])
    assert spread([], []) == []


def test_labels_keep_their_order_and_their_distance() -> None:
    wanted, sizes = [3.0, 1.0, 2.9, 9.0, 3.1], [1.0, 4.0, 2.0, 1.0, 3.0]
    places = spread(wanted, sizes)
    order = sorted(range(5), key=wanted.__getitem__)
    for one, other in pairwise(order):
        assert places[other] - places[one] >= (sizes[one] + sizes[other]) / 2 - 1e-9


def overlaps(results: Results, kind: str, style: Style) -> list[str]:
    """Pairs of texts of a picture whose boxes meet, and texts that leave the picture."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.text import Text

    figure = picture(results, kind, style)
    canvas: Any = FigureCanvasAgg(figure)
    figure.draw_without_rendering()
    boxes = []
    for text in figure.findobj(Text):
        if isinstance(text, Text) and text.get_visible() and text.get_text().strip():
            if is_hidden_tick(text):
                continue
            boxes.append((text.get_text(), text.get_window_extent(canvas.get_renderer())))
    whole = figure.bbox
    wrong = [
        f"{name} leaves the picture"
        for name, box in boxes
        if box.x0 < 0 or box.y0 < 0 or box.x1 > whole.x1 or box.y1 > whole.y1
    ]
    for (name, one), (other, two) in combinations(boxes, 2):
        across = min(one.x1, two.x1) - max(one.x0, two.x0)
        if across > 0.5 and min(one.y1, two.y1) - max(one.y0, two.y0) > 0.5:
            wrong.append(f"{name} / {other}")
    assert boxes
    return wrong


def is_hidden_tick(text: Any) -> bool:
    """Whether a text belongs to a tick beyond the ends of its axis, or to axes that are off."""
    axes = text.axes
    if axes is None or not axes.axison:
        return axes is not None and text not in axes.texts
    own = {*axes.get_yticklabels(), *axes.get_xticklabels()}
    if text in own:
        low, high = sorted(axes.get_ylim())
        return not low - 1e-9 <= text.get_position()[1] <= high + 1e-9
    return text not in axes.texts


def has_picture(kind: str, name: str) -> bool:
    return kind != "plan" or name not in WITHOUT_PLAN


OURS = ("plan", "lever", "efficiency")
STYLES = (Style(), Style("ru", dark=True))


@pytest.mark.parametrize("kind", OURS)
@pytest.mark.parametrize(("name", "style"), list(zip(QUICK, STYLES, strict=True)))
def test_no_label_covers_another(name: str, style: Style, kind: str) -> None:
    assert overlaps(result(name), kind, style) == []


@pytest.mark.slow
@pytest.mark.parametrize("kind", OURS)
@pytest.mark.parametrize("name", SHIPPED)
def test_no_label_covers_another_in_any_shipped_case(name: str, kind: str) -> None:
    if has_picture(kind, name):
        style = STYLES[SHIPPED.index(name) % len(STYLES)]
        assert overlaps(result(name), kind, style) == []


@pytest.mark.parametrize(("kind", "form"), list(zip(OURS, FORMATS, strict=True)))
def test_the_same_case_gives_the_same_bytes(umdm: Results, kind: str, form: Format) -> None:
    assert render(umdm, kind, form, Style()) == render(umdm, kind, form, Style())


def test_a_picture_holds_no_date(umdm: Results) -> None:
    assert b"<dc:date>" not in render(umdm, "efficiency", "svg", Style())
    assert b"CreationDate" not in render(umdm, "efficiency", "pdf", Style())


def test_a_picture_does_not_ask_for_a_screen() -> None:
    code = (
        "import sys; from vstatics import load, solve\n"
        "from vstatics.pictures import picture\n"
        "from vstatics.pictures.style import Style\n"
        "assert 'matplotlib' not in sys.modules\n"
        f"picture(solve(load({str(CASES / 'umdm.yaml')!r})), 'plan', Style())\n"
        "assert 'matplotlib.pyplot' not in sys.modules"
    )
    done = subprocess.run([sys.executable, "-c", code], check=False, capture_output=True)
    assert done.returncode == 0, done.stderr.decode()


STARTS = {"svg": b"<?xml", "png": b"\x89PNG", "pdf": b"%PDF"}


@pytest.mark.parametrize("form", FORMATS)
def test_the_suffix_tells_the_format(form: str, tmp_path: Path) -> None:
    target = tmp_path / f"losses.{form}"
    said = vstatics("plot", CASES / "umdm.yaml", "--kind", "efficiency", "-o", target)
    assert (said.status, said.all) == (0, "")
    assert target.read_bytes().startswith(STARTS[form])


def test_a_picture_goes_through_a_pipe() -> None:
    case = (CASES / "mzkt7922.dat").read_bytes()
    said = vstatics("plot", "-", "--kind", "lever", "--gear", "2", "-o", "-", stdin=case)
    assert said.status == 0
    assert said.out.startswith("<?xml")
    assert said.out.rstrip().endswith("</svg>")


def test_another_suffix_is_wrong_use(tmp_path: Path) -> None:
    said = vstatics("plot", CASES / "umdm.yaml", "-k", "plan", "-o", tmp_path / "plan.bmp")
    assert said.status == 2
    assert "expected a suffix of .svg .png .pdf" in said.err


def test_an_unknown_gear_is_told_with_those_that_there_are(tmp_path: Path) -> None:
    said = vstatics(
        "plot", CASES / "umdm.yaml", "-k", "plan", "--gear", "9", "-o", tmp_path / "a.svg"
    )
    assert said.status == 2
    assert "no gear '9'; gears are 1, 2, 3, 4, R" in said.err
    assert list(tmp_path.iterdir()) == []


def test_a_case_without_a_plan_says_so(tmp_path: Path) -> None:
    said = vstatics("plot", CASES / "wheel-hub.yaml", "-k", "plan", "-o", tmp_path / "a.svg")
    assert said.status == 1
    assert "wheel-hub.yaml: error: a kinematic plan shows" in said.err


def test_without_matplotlib_the_command_names_the_extra(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)  # noqa: ARG005
    said = vstatics("plot", CASES / "umdm.yaml", "-k", "plan", "-o", tmp_path / "a.svg")
    assert said.status == 1
    assert 'a picture needs the package matplotlib: pip install "vstatics[plot]"' in said.err


@pytest.mark.parametrize("kind", OURS)
@pytest.mark.parametrize("text", [NEUTRAL, TIED_UP, LOCKED])
def test_gears_without_a_solution_do_not_stop_a_picture(kind: str, text: str) -> None:
    said = vstatics("plot", "-", "--kind", kind, "-o", "-", stdin=text.encode())
    if (kind, text) == ("efficiency", LOCKED):
        assert "the case has no efficiency that could be drawn" in said.err
        return
    assert said.status == int(text == TIED_UP)
    assert said.out.startswith("<?xml")


def test_every_kind_of_picture_has_its_module() -> None:
    for module in PICTURES.values():
        assert callable(import_module(module).draw)
