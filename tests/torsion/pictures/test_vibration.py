"""Pictures of vibration: what they show is what the modes are, and no label covers another."""

import importlib.util
from pathlib import Path

import pytest
from matplotlib.colors import to_rgba

from tests.commands import CASES, vstatics
from tests.pictures import drawn
from tests.pictures.test_pictures import STYLES, overlaps
from tests.shipped import shipped_results
from tests.torsion.systems import sprung
from vstatics import CaseError, Gear, Mechanism, Results, ShiftElement, Spring, Transmission, solve
from vstatics.core.texts import Language
from vstatics.pictures import drawn_kinds, module_of, picture
from vstatics.pictures.drawing.files import figures_of
from vstatics.pictures.drawing.style import PAGE_HEIGHT, PAGE_WIDTH, Style
from vstatics.torsion.pictures.shapes import modes
from vstatics.torsion.pictures.shapes.links import mode_links
from vstatics.torsion.pictures.shown_modes import modes_of

COLOURS = Style().colours
PAGE = Style(height=PAGE_HEIGHT)
NARROW = Style(width=0.8 * PAGE_WIDTH, height=0.85 * PAGE_HEIGHT)
KINDS = ("modes", "campbell", "response")
SHIPPED = ("moskvich412.yaml", "driveline-8hp70.yaml")


def chain(count: int, name: str = "m", stiffness: float = 1e4) -> Results:
    links = range(1, count + 1)
    springs = [Spring({k: 1, k + 1: -1}, stiffness, name=f"s{k}") for k in links[:-1]]
    inertias, names = dict.fromkeys(links, 0.1), [f"{name} {link}" for link in links]
    case = Transmission(count, [], [], [], springs=springs, inertias=inertias, link_names=names)
    return solve(case)


def one_mass() -> Results:
    springs = [Spring({1: 1}, 100.0, name="mount")]
    return solve(sprung(1, springs, {1: 1.0}))


def tied() -> Results:
    """A set of which one gear holds a link too many."""
    brakes = [ShiftElement(2, name="B"), ShiftElement(3, name="C")]
    gears = [Gear([1], name="low"), Gear([1, 2], name="both")]
    springs = [Spring({3: 1}, 50.0, name="mount", damping=2.0), Spring({1: 1}, 50.0, name="first")]
    springs.append(Spring({1: 1}, 20.0, name="second"))
    sets, inertias = [Mechanism(1, 2, 3, -2.0, name="set")], {1: 1.0, 3: 10.0}
    return solve(Transmission(3, brakes, sets, gears, springs=springs, inertias=inertias))


ODD = {
    "two masses": chain(2), "one mass": one_mass(), "sixteen masses": chain(16),
    "long names": chain(5, "the intermediate shaft of the auxiliary drive"),
    "a long word": chain(3, "x" * 70), "many masses": chain(55), "a gear that is tied up": tied(),
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", [*ODD, *SHIPPED])
def test_no_label_covers_another(name: str, kind: str) -> None:
    style = STYLES[[*ODD, *SHIPPED].index(name) % len(STYLES)]
    assert overlaps(ODD.get(name) or shipped_results(name), kind, style) == []


@pytest.mark.parametrize("language", ["en", "ru"])
def test_what_is_said_of_a_mode_keeps_clear_of_its_bars(language: Language) -> None:
    results = shipped_results("moskvich412.yaml")
    for width in (PAGE_WIDTH, 0.7 * PAGE_WIDTH, 0.5 * PAGE_WIDTH):
        assert overlaps(results, "modes", Style(width=width, language=language)) == []


def texts(results: Results, kind: str, *gears: int) -> list[str]:
    return drawn.texts(picture(results, kind, Style(), gears))


def test_a_mode_has_its_frequencies_and_shares() -> None:
    """Two equal masses: omega^2 = 2 c/J, half of the energy of motion in each."""
    figure = picture(chain(2, stiffness=500.0), "modes", Style())
    shown = drawn.texts(figure)
    assert "mode 1    15.92 Hz    100.0 rad/s" in shown
    assert shown.count("50%") == 2
    bars = {said: one.get_facecolor() for said, one in drawn.titled(figure) if "%" in said}
    assert [bars[f"m {link}: 50%"] for link in (1, 2)] == [to_rgba(one) for one in COLOURS[:2]]
    assert shown.count("100%") == 1


def test_links_stand_in_the_order_in_which_power_comes_to_them() -> None:
    """And not in that of the case; what stands and what nothing loads is left out, and told."""
    pairs = [Mechanism(2, 5, 0, -2.0, name="pair"), Mechanism(2, 4, 0, -3.0, name="idle pair")]
    springs = [Spring({1: 1, 2: -1}, 9.0, name="shaft"), Spring({5: 1, 3: -1}, 9.0, name="axle")]
    brake = ShiftElement(6, name="B")
    case = Transmission(
        *(6, [brake], pairs, [Gear([1])]), springs=springs, inertias={1: 1.0, 3: 5.0, 6: 1.0},
        output=3, link_names=["engine", "hub", "vehicle", "loose wheel", "wheel", "held"],
    )  # fmt: skip
    results = solve(case)
    row = mode_links(results, 1, modes_of(results)[0])
    assert row.names == ("engine", "hub", "wheel", "vehicle")
    assert row.heavy == (True, False, False, True)
    assert [(one.name, one.elastic, one.members) for one in row.devices] == [
        ("shaft", True, (0, 1)), ("axle", True, (2, 3)), ("pair", False, (1, 2)),
    ]  # fmt: skip
    note = "amplitudes of links, the largest is 1; at rest: held; without load: loose wheel"
    assert note in texts(results, "modes")


def test_devices_beside_each_other_have_levels_of_their_own() -> None:
    twists: list[dict[int, float]] = [{1: 1, 2: -1}, {1: 1, 2: -1}, {1: 1, 2: -2, 3: 1}, {3: 1}]
    springs = [Spring(twist, 9.0) for twist in (*twists, {3: 1.0})]
    results = solve(sprung(3, springs, {1: 1, 2: 1, 3: 1}))
    row = mode_links(results, 1, modes_of(results)[0])
    levels = [((0, 1), 0), ((0, 1), 1), ((0, 1, 2), 2), ((2,), 0), ((2,), 1)]
    assert [(one.members, one.level) for one in row.devices] == levels


def test_the_first_gear_is_shown_unless_others_are_asked_for() -> None:
    results = shipped_results("moskvich412.yaml")
    assert [one for one in texts(results, "modes") if one.startswith("gear ")] == ["gear 1"]
    shown = texts(results, "modes", 4, 8)
    assert [one for one in shown if one.startswith("gear ")] == ["gear 4", "gear 4 at stop"]
    numbers = solve(chain(2).case.replace(gears=[Gear(name="2"), Gear(name="1")]))
    assert [gear.name for gear in modes_of(numbers, [1])] == ["2"]  # by number, not by name


def test_damping_is_stated_of_what_is_damped() -> None:
    for results, is_told in ((tied(), True), (chain(2), False)):
        assert any("damping" in one for one in texts(results, "modes")) == is_told


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", ODD)
@pytest.mark.parametrize("style", [PAGE, NARROW])
def test_no_page_is_larger_than_its_paper_and_no_letter_small(
    name: str, kind: str, style: Style
) -> None:
    module = module_of(kind)
    for figure in figures_of([*module.draw(ODD[name], style)]):
        wide, high = (72 * size for size in figure.get_size_inches())
        assert wide <= style.width + 0.01
        assert high <= style.height + 0.01
        assert min(float(text.get_fontsize()) for text in figure.texts) >= 7


def test_pages_have_all_modes_and_all_gears() -> None:
    figures = modes.draw(ODD["sixteen masses"], PAGE)
    assert len(figures) > 1
    told = [text for figure in figures for text in drawn.texts(figure)]
    numbers = [text.split("    ")[0] for text in told if text.startswith("mode ")]
    assert numbers == [f"mode {number}" for number in range(1, 16)]
    told = [text for one in modes.draw(tied(), PAGE) for text in drawn.texts(one)]
    sheets = [text for text in told if text.startswith(("gear ", "tied"))]
    assert sheets == ["gear low", "gear both", "tied up"]


def test_links_are_not_crowded_on_half_a_page() -> None:
    """Names of 8 pt need 10 pt each with a gap, so every second of 17 links has its name."""
    results = shipped_results("driveline-8hp70.yaml")
    figure = picture(results, "modes", Style(width=PAGE_WIDTH / 2))
    names = [one for one in figure.texts if one.get_rotation() == 90]
    at = {one.get_text(): one.get_position()[0] for one in names}
    assert at["vehicle"] - at["engine"] >= 8 * 10


def test_a_gear_that_is_tied_up_says_so_beside_others() -> None:
    assert "gear both: tied up" in "".join(texts(tied(), "campbell"))
    assert any(one.startswith("tied up") for one in texts(tied(), "response"))
    assert "tied up" in texts(tied(), "modes", 1, 2)
    with pytest.raises(CaseError, match="gear both has no natural frequency: tied up: B, C and"):
        picture(tied(), "modes", Style(), (2,))


ANCHORED = "inertias: {a: 1}\nsprings: {s: {links: [a], stiffness: 100}}\n"
"""One mass on a spring to the housing."""
COUPLED = "links: [a, b]\noutput: b\nshift_elements: {B: [a, housing], C: [a, b]}\n"
STUCK = ANCHORED + COUPLED + "gears: {free: [C], both: [B, C]}\n"


@pytest.mark.parametrize("kind", ["modes", "campbell", "response"])
def test_springs_that_hold_the_input_in_statics_let_it_vibrate(kind: str, tmp_path: Path) -> None:
    """Thomson, Theory of vibration: sqrt(100/1) rad/s is 1.592 Hz, with no fault of the case."""
    call = ("plot", "-", "-k", kind, "-o", tmp_path / "a.svg")
    assert vstatics(*call, stdin=ANCHORED.encode()) == (0, "", "")
    assert kind == "response" or "1.592" in (tmp_path / "a.svg").read_text(encoding="utf-8")
    stuck = vstatics(*call, stdin=STUCK.encode())
    assert stuck.status == 1
    assert "gears free and both: tied up" in stuck.err


CONVERTER = """
links: [engine, turbine, hub, wheels]
load: {speed: 2000 rpm, torque: 80 N*m}
shift_elements: {A: [turbine, hub], L: [engine, turbine]}
mechanisms: {TC: {kind: converter, first: engine, second: turbine, points: POINTS}}
inertias: {engine: 0.15, turbine: 0.05, hub: 0.1, wheels: 9}
springs: {shaft: {links: [hub, wheels], stiffness: 14000}}
gears:
  {N: {engaged: [], kind: neutral}, slip: {engaged: [A], slip: {L: 50 rpm}}, "1": [A], 1L: [A, L]}
""".replace("POINTS", "[[0, 2.2, 0.0022], [0.8, 1.15, 0.0016], [1, 1, 0]]")


@pytest.mark.parametrize("kind", ["campbell", "response"])
def test_behind_a_converter_a_neutral_gear_and_a_slip_vibrate_like_others(
    kind: str, tmp_path: Path
) -> None:
    """By hand: sqrt(14000 (1/9 + 1/J)) has 59.88 Hz for the hub, 49.03 Hz with the turbine."""
    call = ("plot", "-", "-k", kind, "-o", tmp_path / "a.svg")
    assert vstatics(*call, stdin=CONVERTER.encode())[::2] == (0, "")
    text = (tmp_path / "a.svg").read_text(encoding="utf-8")
    titles = [
        "the input is at rest in all modes of gear N, slip, 1;",
        "mode 1, gear N: 59.88 Hz",
        "mode 1, gear slip, 1: 49.03 Hz",
    ]
    assert kind != "campbell" or all(title in text for title in titles)


@pytest.mark.parametrize("kind", KINDS)
def test_what_is_missing_is_said(
    kind: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    assert kind in drawn_kinds()
    options = ("-k", kind, "-o", tmp_path / "a.svg")
    said = vstatics("plot", CASES / "simpson.yaml", *options)
    assert said.fails("simpson.yaml", "error: inertias: nothing has an inertia, so nothing")
    find = importlib.util.find_spec
    monkeypatch.setattr(
        importlib.util, "find_spec", lambda name, *of: None if name == "scipy" else find(name, *of)
    )
    said = vstatics("plot", CASES / "moskvich412.yaml", *options)
    package = 'the package scipy: pip install ".[torsion]" in the source folder'
    assert said.fails(f"a picture of natural modes needs {package}")
    assert list(tmp_path.iterdir()) == []
