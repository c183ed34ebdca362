"""Pictures of vibration: what they show is what the modes are, and no label covers another."""

from __future__ import annotations

import importlib.util
from pathlib import Path

import pytest
from matplotlib.colors import to_rgba
from matplotlib.lines import Line2D

from tests.commands import CASES, vstatics
from tests.pictures import drawn
from tests.pictures.test_pictures import STYLES, overlaps
from vstatics import Gear, Load, Mechanism, Results, ShiftElement, Spring, Transmission, load, solve
from vstatics.errors import CaseError
from vstatics.pictures import PICTURES, Format, picture, render
from vstatics.pictures.sheet.style import PAGE_HEIGHT, Style
from vstatics.pictures.vibration.campbell import OrderRange, crossings, highest_speed, order_range
from vstatics.pictures.vibration.links import mode_links
from vstatics.pictures.vibration.shown_modes import modes_of

COLOURS = Style().colours
KINDS = ("modes", "campbell")
SHIPPED = ("moskvich412.yaml", "driveline-8hp70.yaml")


def chain(count: int, name: str = "m", stiffness: float = 1e4) -> Results:
    """Equal masses on equal shafts."""
    links = range(1, count + 1)
    springs = [Spring({k: 1, k + 1: -1}, stiffness, name=f"s{k}") for k in links[:-1]]
    names = [f"{name} {link}" for link in links]
    return solve(
        Transmission(
            *(count, [], [], []),
            springs=springs,
            inertias=dict.fromkeys(links, 0.1),
            link_names=names,
        )
    )


def one_mass() -> Results:
    springs = [Spring({1: 1}, 100.0, name="mount")]
    return solve(Transmission(1, [], [], [], springs=springs, inertias={1: 1.0}))


def tied() -> Results:
    """A set of which one gear holds a link too many."""
    brakes = [ShiftElement(2, name="B"), ShiftElement(3, name="C")]
    gears = [Gear([1], name="low"), Gear([1, 2], name="both")]
    springs = [
        Spring({3: 1}, stiffness=50.0, name="mount", damping=2.0),
        Spring({1: 1}, stiffness=50.0, name="first"),
        Spring({1: 1}, stiffness=20.0, name="second"),
    ]
    case = Transmission(
        *(3, brakes, [Mechanism(1, 2, 3, -2.0, name="set")], gears),
        springs=springs,
        inertias={1: 1.0, 3: 10.0},
    )
    return solve(case)


ODD = {
    "two masses": chain(2),
    "one mass": one_mass(),
    "sixteen masses": chain(16),
    "long names": chain(5, "the intermediate shaft of the auxiliary drive"),
    "a long word": chain(3, "x" * 70),
    "many masses": chain(55),
    "a gear that is tied up": tied(),
}


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", ODD)
def test_no_label_covers_another(name: str, kind: str) -> None:
    style = STYLES[list(ODD).index(name) % len(STYLES)]
    assert overlaps(ODD[name], kind, style) == []


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(("name", "style"), list(zip(SHIPPED, STYLES, strict=True)))
def test_no_label_covers_another_in_shipped_cases(name: str, style: Style, kind: str) -> None:
    assert overlaps(solve(load(CASES / name)), kind, style) == []


@pytest.mark.parametrize(("kind", "form"), [("modes", "svg"), ("campbell", "pdf")])
def test_the_same_case_gives_the_same_bytes(kind: str, form: Format) -> None:
    results = ODD["two masses"]
    assert render(results, kind, form, Style()) == render(results, kind, form, Style())


def texts(results: Results, kind: str, *gears: int) -> list[str]:
    return drawn.texts(picture(results, kind, Style(), gears))


def test_a_mode_has_its_frequencies_and_shares() -> None:
    """Two equal masses: omega^2 = 2 c/J, half of the energy of motion in each."""
    shown = texts(chain(2, stiffness=500.0), "modes")
    assert "mode 1\n15.92 Hz\n100.0 rad/s" in shown
    assert shown.count("50%") == 2
    figure = picture(chain(2, stiffness=500.0), "modes", Style())
    bars = {said: one.get_facecolor() for said, one in drawn.titled(figure) if "%" in said}
    assert [bars[f"m {link}: 50%"] for link in (1, 2)] == [to_rgba(one) for one in COLOURS[:2]]
    assert shown.count("100%") == 1


def test_links_stand_in_the_order_in_which_power_comes_to_them() -> None:
    """And not in that of the case; what stands and what nothing loads is left out, and told."""
    pairs = [Mechanism(2, 5, 0, -2.0, name="pair"), Mechanism(2, 4, 0, -3.0, name="idle pair")]
    springs = [Spring({1: 1, 2: -1}, 9.0, name="shaft"), Spring({5: 1, 3: -1}, 9.0, name="axle")]
    brake = ShiftElement(6, name="B")
    case = Transmission(
        *(6, [brake], pairs, [Gear([1])]),
        springs=springs,
        inertias={1: 1.0, 3: 5.0, 6: 1.0},
        output=3,
        link_names=["engine", "hub", "vehicle", "loose wheel", "wheel", "held"],
    )
    results = solve(case)
    [modes] = modes_of(results)
    row = mode_links(results, 1, modes)
    assert row.names == ("engine", "hub", "wheel", "vehicle")
    assert row.heavy == (True, False, False, True)
    assert [(one.name, one.elastic, one.members) for one in row.devices] == [
        ("shaft", True, (0, 1)),
        ("axle", True, (2, 3)),
        ("pair", False, (1, 2)),
    ]
    note = "amplitudes of links, the largest is 1; these stand: held; without load: loose wheel"
    assert note in texts(results, "modes")


def test_devices_beside_each_other_have_levels_of_their_own() -> None:
    springs = [
        Spring({1: 1, 2: -1}, 9.0),
        Spring({1: 1, 2: -1}, 9.0),
        Spring({1: 1, 2: -2, 3: 1}, 9.0),
        Spring({3: 1}, 9.0),
        Spring({3: 1}, 9.0),
    ]
    results = solve(Transmission(3, [], [], [], springs=springs, inertias={1: 1, 2: 1, 3: 1}))
    row = mode_links(results, 1, modes_of(results)[0])
    assert [(one.members, one.level) for one in row.devices] == [
        ((0, 1), 0),
        ((0, 1), 1),
        ((0, 1, 2), 2),
        ((2,), 0),
        ((2,), 1),
    ]


def test_the_first_gear_is_shown_unless_others_are_asked_for() -> None:
    results = solve(load(CASES / "moskvich412.yaml"))
    assert [one for one in texts(results, "modes") if one.startswith("gear ")] == ["gear 1"]
    shown = texts(results, "modes", 4, 8)
    assert [one for one in shown if one.startswith("gear ")] == ["gear 4", "gear 4 at stop"]


def test_damping_is_told_of_what_is_damped() -> None:
    assert any("damping" in one for one in texts(tied(), "modes"))
    assert not any("damping" in one for one in texts(chain(2), "modes"))


def test_sheets_fit_a_printed_page_and_have_all_modes() -> None:
    from vstatics.pictures.vibration import modes

    figures = modes.draw(ODD["sixteen masses"], Style(height=PAGE_HEIGHT))
    assert len(figures) > 1
    for figure in figures:
        wide, high = figure.get_size_inches()
        assert high / wide < 29.7 / 21.0
    told = [text for figure in figures for text in drawn.texts(figure)]
    assert [text.split("\n")[0] for text in told if text.startswith("mode ")] == [
        f"mode {number}" for number in range(1, 16)
    ]


def test_there_are_sheets_for_all_gears() -> None:
    from vstatics.pictures.vibration import campbell, modes

    told = [
        text for one in modes.draw(tied(), Style(height=PAGE_HEIGHT)) for text in drawn.texts(one)
    ]
    assert [text for text in told if text.startswith(("gear ", "tied"))] == [
        "gear low",
        "gear both",
        "tied up",
    ]
    results = solve(load(CASES / "moskvich412.yaml"))
    pages = [drawn.texts(one) for one in campbell.draw(results, Style(height=PAGE_HEIGHT))]
    assert [sum(text.startswith("gear ") for text in page) for page in pages] == [6, 2]


def test_a_gear_that_is_tied_up_says_so_beside_others() -> None:
    assert "tied up" in texts(tied(), "campbell")
    assert "tied up" in texts(tied(), "modes", 1, 2)
    with pytest.raises(CaseError, match="gear both has no natural frequency: tied up: B, C and"):
        picture(tied(), "modes", Style(), (2,))


@pytest.mark.parametrize("kind", KINDS)
def test_a_case_that_does_not_vibrate_says_so(kind: str, tmp_path: Path) -> None:
    said = vstatics("plot", CASES / "simpson.yaml", "-k", kind, "-o", tmp_path / "a.svg")
    assert said.status == 1
    assert "simpson.yaml: error: nothing has an inertia, so nothing vibrates" in said.err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("kind", KINDS)
def test_without_scipy_the_command_names_the_extra(
    kind: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    found = importlib.util.find_spec
    monkeypatch.setattr(
        importlib.util,
        "find_spec",
        lambda name, package=None: None if name == "scipy" else found(name, package),
    )
    said = vstatics("plot", CASES / "moskvich412.yaml", "-k", kind, "-o", tmp_path / "a.svg")
    assert said.status == 1
    needs = 'a picture of natural modes needs the package scipy: pip install "vstatics[torsion]"'
    assert needs in said.err


def test_orders_meet_frequencies_at_their_speeds() -> None:
    """``speed = 60 f/order``."""
    found = crossings(OrderRange(3000.0, 200.0), [30.0, 90.0, 210.0])
    assert {(one.frequency, one.order): one.speed for one in found} == {
        (30.0, 1.0): 1800.0,
        (30.0, 2.0): 900.0,
        (30.0, 3.0): 600.0,
        (30.0, 4.0): 450.0,
        (30.0, 6.0): 300.0,
        (90.0, 2.0): 2700.0,
        (90.0, 3.0): 1800.0,
        (90.0, 4.0): 1350.0,
        (90.0, 6.0): 900.0,
    }


def test_a_campbell_diagram_shows_frequencies_that_orders_reach_and_names_the_others() -> None:
    """A fifth above 6 x 6000 rpm, 600 Hz, is beyond; of equal masses omega^2 = 2 c/J."""
    shown = texts(chain(2, stiffness=0.05 * (240 * 3.14159265) ** 2), "campbell")
    assert "1: 120.0 Hz" in shown
    assert {"3600", "2400", "1800", "1200"} <= set(shown)
    assert order_range(6000.0, [30.0, 720.0]).frequency == pytest.approx(33.0)
    beyond = texts(chain(2, stiffness=0.05 * (1440 * 3.14159265) ** 2), "campbell")
    assert "1: 720.0 Hz ↑" in beyond


@pytest.mark.parametrize(("link", "excited"), [(1, False), (3, True)])
def test_a_mode_in_which_the_input_stands_has_no_resonance(link: int, excited: bool) -> None:
    """Two equal wheels on equal half-shafts, in antiphase at ``sqrt(c/J)``, 5 rad/s or 0.8 Hz."""
    twists = [{1: 1, 2: -1}, {2: 1, 3: -1}, {2: 1, 4: -1}]
    springs = [
        Spring(twist, c, name=f"s{n}")
        for n, (twist, c) in enumerate(zip(twists, (70.0, 50.0, 50.0), strict=True))
    ]
    inertias = {1: 9.0, 2: 1.0, 3: 2.0, 4: 2.0}
    case = Transmission(*(4, [], [], []), springs=springs, inertias=inertias, input=link, output=4)
    figure = picture(solve(case), "campbell", Style())
    dots = [said for said, _ in drawn.titled(figure) if " rpm, 0.796 Hz" in said]
    assert bool(dots) == excited
    assert all(said.endswith(", participation 1") for said in dots)
    assert sum(" rpm, " in said for said, _ in drawn.titled(figure)) > 6


@pytest.mark.slow
def test_no_number_of_a_resonance_lies_on_a_line_or_point() -> None:
    """Issue 16; where there is no room the dot has its speed in its title only."""
    figure = picture(solve(load(CASES / "driveline-8hp70.yaml")), "campbell", Style(), [1])
    titled = [(said, line) for said, line in drawn.titled(figure) if isinstance(line, Line2D)]
    lines = [line for _, line in titled]
    numbers = [text for text in figure.texts if float(text.get_fontsize()) < 8]
    assert 5 < len(numbers) < len([said for said, _ in titled if " rpm, " in said])
    figure.draw_without_rendering()
    for text in numbers:
        box = text.get_window_extent()
        for line in lines:
            path = line.get_transform().transform_path(line.get_path())
            assert not path.intersects_bbox(box, filled=False), (text.get_text(), line.get_gid())


def test_the_speeds_go_beyond_the_load_of_any_gear() -> None:
    gears = [Gear(), Gear(load=Load(-3000.0))]
    case = Transmission(2, [], [Mechanism(1, 2, 0, -2.0)], gears, load=Load(1000.0))
    assert highest_speed(case, case.gears, [50.0]) == 4000.0
    assert highest_speed(case, case.gears[:1], [50.0]) == 1500.0


def test_kinds_are_known() -> None:
    assert set(KINDS) < set(PICTURES)
