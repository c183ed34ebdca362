"""Campbell diagrams: every resonance of every gear, at its speed, and how much it matters."""

import json
import math
from pathlib import Path
from typing import Any

import pytest

from tests.chance import each_seed, seeded
from tests.commands import CASES, json_answer, vstatics
from tests.installed import needs
from tests.pictures import drawn as said
from tests.shipped import shipped_results
from tests.torsion.pictures.marks import PAPER, Mark, drawn, marks, plotted, tree
from tests.torsion.systems import wheels
from vstatics import Damping, Gear, Load, Results, Spring, Transmission, load, solve
from vstatics.pictures import picture
from vstatics.pictures.drawing.style import Excitation, Style
from vstatics.torsion.pictures.orders.orders_and_speeds import ORDERS, running_speeds

FASTEST = {
    "driveline-8hp70.yaml": 5000.0,  # a quarter above 4000 rpm
    "moskvich412.yaml": 7500.0,  # above 5800 rpm: 7250
    "tarasik-truck.yaml": 2500.0,
    "moskvich-start.yaml": 6000.0,  # without a load
}
"""The shipped cases that have modes, with the ends of their scales [rpm]."""


def shaft(stiffness: float, **more: Any) -> Results:
    """Two equal masses of 0.1 kg*m^2: omega^2 = 2 c/J, both move alike."""
    springs = [Spring({1: 1, 2: -1}, stiffness, name="shaft")]
    inertias = {1: 0.1, 2: 0.1}
    return solve(Transmission(*(2, [], [], []), springs=springs, inertias=inertias, **more))


def of_frequency(hertz: float, **more: Any) -> Results:
    return shaft(0.05 * (2 * math.pi * hertz) ** 2, **more)


@pytest.mark.parametrize(
    ("kind", "text"),
    [("campbell", "Campbell diagram, gear 3L"), ("response", "gear 3L"), ("modes", "gear 3L")],
)
def test_a_gear_is_drawn_whose_number_is_the_name_of_another_gear(kind: str, text: str) -> None:
    gears = [Gear(name=name) for name in ("1", "3", "3L")]
    results = solve(of_frequency(30.0).case.replace(gears=gears))
    assert text in " ".join(said.texts(picture(results, kind, Style(), gears=[3])))


def resonances(svg: bytes) -> dict[tuple[str, int, float], Mark]:
    found = marks(svg, "resonance")
    keys = [(one.data["gear"], int(one.data["mode"]), float(one.data["order"])) for one in found]
    assert len(set(keys)) == len(keys)
    return dict(zip(keys, found, strict=True))


@pytest.mark.parametrize("name", FASTEST)
def test_there_is_a_dot_for_each_resonance_of_the_modes(name: str, tmp_path: Path) -> None:
    """Those of ``torsion modes`` in which the input moves, up to the end of the scale.

    Both scales are linear: speed and frequency by one factor each, from the corner.
    """
    svg = plotted(tmp_path, CASES / name, "-k", "campbell")
    lines = {float(one.data["order"]): one.points for one in marks(svg, "order")}
    assert [*lines] == sorted(lines)
    case = load(CASES / name)
    entry = case.link_name(case.input)
    expected = {
        (gear["name"], number, order): (60 * mode["frequency"] / order, abs(mode["shape"][entry]))
        for gear in json_answer("torsion", "modes", CASES / name)["gears"]
        for number, mode in enumerate(gear["modes"], 1)
        for order in lines
        if 60 * mode["frequency"] / order <= FASTEST[name] and abs(mode["shape"][entry]) > 1e-9
    }
    found = resonances(svg)
    assert len(expected) > 10
    assert found.keys() == expected.keys()
    [corner] = {line[0] for line in lines.values()}
    right = lines[min(lines)][-1][0]
    rises = {order: (corner[1] - y) / (x - corner[0]) for order, (_, (x, y)) in lines.items()}
    for key, one in found.items():
        order, across = key[2], one.at[0] - corner[0]
        speed = float(one.data["rpm"])
        assert across == pytest.approx(speed / FASTEST[name] * (right - corner[0]), abs=0.02)
        assert corner[1] - one.at[1] == pytest.approx(across * rises[order], abs=0.05)
        assert rises[order] == pytest.approx(order * rises[1.0], rel=1e-3)
        of_mode = speed, float(one.data["participation"])
        assert of_mode == pytest.approx(expected[key], rel=1e-9)


@pytest.mark.parametrize("cylinders", [1, 2, 3, 4, 5, 6, 8, 12])
def test_half_the_cylinders_fire_in_a_revolution_and_multiples(cylinders: int) -> None:
    asked = Style(excited=Excitation(orders=tuple(n / 2 for n in range(1, 31))))
    for style in (Style(), asked):
        own = marks(drawn(of_frequency(30.0, cylinders=cylinders), "campbell", style), "order")
        found = {float(one.data["order"]): json.loads(one.data["firing"]) for one in own}
        assert cylinders / 2 in found
        for order, fires in found.items():
            assert fires == (round(2 * order) % cylinders == 0)
    assert [float(one.data["order"]) for one in own] == list(asked.excited.orders)


def test_a_mode_far_below_the_orders_is_at_two_thirds_of_the_height() -> None:
    svg = drawn(of_frequency(30.0, cylinders=4), "campbell")
    (_, low), (_, high) = marks(svg, "order")[-1].points
    assert {round((low - one.at[1]) / (low - high), 3) for one in marks(svg, "resonance")} == {
        0.667
    }


def test_firing_orders_have_a_colour_and_width_of_their_own() -> None:
    looks: dict[str, set[tuple[str | None, ...]]] = {"true": set(), "false": set()}
    for one in marks(drawn(of_frequency(30.0, cylinders=4), "campbell"), "order"):
        paths = [path for path in one.element.iter() if path.get("d")]
        looks[one.data["firing"]] |= {
            (path.get("stroke"), path.get("stroke-width")) for path in paths
        }
    [(colour, width)], [(other, thinner)] = looks["true"], looks["false"]
    assert colour != other
    assert width != thinner
    bare = marks(drawn(of_frequency(30.0), "campbell"), "order")
    firing = {float(one.data["order"]): one.data["firing"] for one in bare}
    assert firing == dict.fromkeys(ORDERS, "false")


def test_dots_are_larger_where_the_input_takes_part() -> None:
    results = shipped_results("driveline-8hp70.yaml")
    figure = picture(results, "campbell", Style(excited=Excitation(orders=(1.0,))))
    by_part = sorted(
        (float(text.split("participation ")[1].split(",")[0]), one.get_markersize())
        for text, one in said.titled(figure)
        if "participation" in text
    )
    sizes = [size for _, size in by_part]
    assert sizes == sorted(sizes)
    assert sizes[0] < sizes[-1]


@pytest.mark.parametrize(("loss", "place"), [(0.0, 0), (0.02, 0), (0.1, 1), (0.4, 2)])
def test_the_fill_tells_the_damping(loss: float, place: int) -> None:
    """A loss factor is twice the damping ratio; below .02 ink, from .1 on paper."""
    springs = [Spring({1: 1, 2: -1}, 3e3, damping=Damping(loss_factor=loss))]
    case = Transmission(*(2, [], [], []), springs=springs, inertias={1: 0.1, 2: 0.1})
    style = Style()
    found = marks(drawn(solve(case), "campbell"), "resonance")
    assert {one.fill for one in found} == {(style.ink, style.faint, style.paper)[place]}


@pytest.mark.parametrize(("link", "excited"), [(1, False), (3, True)])
def test_a_mode_in_which_the_input_stands_has_no_resonance(link: int, excited: bool) -> None:
    """Two equal wheels on equal half-shafts, in antiphase at ``sqrt(c/J)``, 5 rad/s or 0.8 Hz."""
    case = wheels(input=link)
    svg = drawn(solve(case), "campbell")
    frequencies = {
        round(float(one.data["rpm"]) * float(one.data["order"]) / 60, 3)
        for one in marks(svg, "resonance")
    }
    assert (0.796 in frequencies) == excited
    assert len(frequencies) > 1
    note = "the input is at rest in mode"
    assert (note in "".join(said.texts(picture(solve(case), "campbell", Style())))) != excited


def test_modes_of_gears_that_are_alike_are_one_line(tmp_path: Path) -> None:
    """Within half a per cent; each gear of each mode stands in one of them."""
    svg = plotted(tmp_path, CASES / "driveline-8hp70.yaml", "-k", "campbell")
    answer = json_answer("torsion", "modes", CASES / "driveline-8hp70.yaml")
    hertz = {
        (gear["name"], number): mode["frequency"]
        for gear in answer["gears"]
        for number, mode in enumerate(gear["modes"], 1)
    }
    lines = [(int(one.data["mode"]), json.loads(one.data["gears"])) for one in marks(svg, "mode")]
    told = [(gear, mode) for mode, gears in lines for gear in gears]
    assert sorted(told) == sorted(key for key, one in hertz.items() if one <= 500.0)
    for mode, gears in lines:
        own = [hertz[gear, mode] for gear in gears]
        assert max(own) <= min(own) * 1.0051
    assert (3, [gear["name"] for gear in answer["gears"]]) in lines


@needs("vehicle")
def test_the_range_is_from_the_least_to_the_largest_speed_that_the_case_tells() -> None:
    from vstatics.vehicle.case.vehicle import Vehicle

    engine = [(100.0, 50.0), (400.0, 80.0)]  # rad/s: 955 to 3820 rpm
    results = of_frequency(40.0, vehicle=Vehicle(1000.0, 0.3, engine=engine))
    figure = picture(results, "campbell", PAPER)
    bold = {one.get_text(): one.get_fontweight() == "bold" for one in figure.texts}
    expected = {"2400": True, "1200": True, "800": False, "600": False}
    assert {text: bold[text] for text in expected} == expected
    gears = [Gear(load=Load(speed=700.0)), Gear(load=Load(speed=-4200.0))]
    case = results.case.replace(gears=gears)
    found = running_speeds(case, case.gears, Excitation())
    assert found == pytest.approx([700.0, 3000 / math.pi, 12000 / math.pi, 4200.0])
    svg = drawn(solve(case), "campbell")
    [band] = marks(svg, "range")
    [order] = [one for one in marks(svg, "order") if one.data["order"] == "0.5"]
    (left, _), (right, _) = order.points
    fastest = 4500.0  # 5 % above, rounded up
    ends = [left + (right - left) * speed / fastest for speed in (700.0, 4200.0)]
    assert sorted({x for x, _ in band.points[:4]}) == pytest.approx(ends, abs=0.02)
    assert marks(drawn(of_frequency(40.0), "campbell"), "range") == []


@needs("simulation")
def test_a_scenario_tells_the_range_of_its_engine(tmp_path: Path) -> None:
    """``over: speed``, points from 80 to 720 rad/s."""
    file = CASES / "scenarios" / "8hp70-shifts.yaml"
    svg = plotted(tmp_path, file, "-k", "campbell", "--gear", "3")
    said = " ".join("".join(one.itertext()) for one in tree(svg).iter())
    assert "the input runs, 764 to 6875 rpm" in said


def test_modes_above_the_highest_order_are_named() -> None:
    """A fifth above 6 x 6000 rpm, 600 Hz."""
    figure = picture(of_frequency(720.0), "campbell", Style())
    texts = said.texts(figure)
    assert "no order meets mode 1 (720.0 Hz)" in texts
    assert any(one.startswith("1: 720.0 Hz") and "↑" in one for one in texts)


def test_many_orders_make_several_tables_no_wider_than_the_page() -> None:
    orders = tuple(float(n) for n in range(1, 25))
    style = Style(excited=Excitation(orders=orders))
    figure = picture(shipped_results("moskvich-start.yaml"), "campbell", style)
    texts = said.texts(figure)
    assert texts.count("mode") > 1
    assert [one for one in texts if one.endswith("×\nrpm")] == [f"{n:g}×\nrpm" for n in orders]
    assert 72 * figure.get_size_inches()[0] <= style.width + 0.01


def test_wrong_use(tmp_path: Path) -> None:
    spans = ("1500:500", "500", "-5:600", "500 Hz:900 Hz", "1:2:3", "5 kg:500", "a:500")
    for kind, *options, why in (
        ("modes", "--orders", "2", "only campbell and response have orders"),
        ("campbell", "--at", "engine", "only a response is that of a link"),
        ("campbell", "--orders", "2,-1", "expected an order above 0"),
        *(("campbell", "--speed", one, f"--speed: read `{one}`, expected a") for one in spans),
    ):
        call = (CASES / "moskvich412.yaml", "-k", kind, *options, "-o", tmp_path / "a.svg")
        said = vstatics("plot", *call)
        assert said.is_wrong_use(why), options
        assert said.err.count("read ") <= 1
    assert list(tmp_path.iterdir()) == []


@each_seed(4, 200)
def test_a_range_of_speeds_has_the_resonances_within_it(seed: int) -> None:
    """Closed form: an order n meets f at 60 f/n rpm, at the part of the range that this is."""
    rng = seeded(seed)
    hertz = rng.uniform(5, 60)
    orders = sorted(rng.sample([0.5, 1.0, 1.5, 2.0, 3.0, 4.0], 3))
    low = rng.choice((0.0, rng.uniform(100, 1500)))
    high = low + rng.uniform(200, 3000)
    expected = {order: 60 * hertz / order for order in orders if low <= 60 * hertz / order <= high}
    excited = Excitation(tuple(orders), shown=(low, high))
    svg = drawn(of_frequency(hertz, load=Load(2000.0)), "campbell", Style(excited=excited))
    found = {order: one for (_, _, order), one in resonances(svg).items()}
    assert found.keys() == expected.keys()
    for order, speed in expected.items():
        assert float(found[order].data["rpm"]) == pytest.approx(speed)
