"""Every kind of element turns as its single meshes say, and as Willis says.

Two ways to the expected speeds, neither of the program: exact fractions from the meshes
of every wheel and planet (`single_meshes`), and the textbook formulas by hand in the tests.
In the formulas a pair of wheels has the internal ratio k = (w_a - w_c)/(w_b - w_c).
"""

from collections.abc import Mapping, Sequence
from fractions import Fraction
from itertools import permutations
from typing import Any

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from tests.core.elements.element_cases import (
    LETTERS,
    LOSSES,
    NO_LOSS,
    PRECISION,
    RAVIGNEAUX,
    STEPPED,
    Held,
    all_held,
    bevel_teeth,
    double_teeth,
    efficiencies,
    link_speeds,
    pair_case,
    ratios,
    ravigneaux_teeth,
    set_case,
    simple_teeth,
    solved,
    stepped_teeth,
    with_speeds_of_single_meshes,
)
from tests.oracle.single_meshes import ContradictionError, speeds
from vstatics import ReadError, loads, solve

Teeth = Mapping[str, int]

EXTERNAL, INTERNAL = 0.98, 0.99
"""Efficiencies of meshes when nothing is said."""
FAR_FROM_ONE = Fraction(1, 50)
"""An internal ratio of 1 makes one piece of a set; near it digits are lost."""
WHEELS = st.integers(12, 90)

EXAMPLES = settings(max_examples=4)


def willis(internal: Mapping[str, Fraction], gear: Held) -> Fraction:
    """The ratio of a gear by Willis's equation.

    `internal` are the speeds of the wheels for a speed 1 of any one of them, the carrier held.
    """

    def on_a_standing_carrier(first: str, second: str) -> Fraction:
        return internal[first] / internal[second]

    match gear:
        case Held("C", first, second):
            return on_a_standing_carrier(first, second)
        case Held(held, first, "C"):
            return 1 - on_a_standing_carrier(first, held)
        case Held(held, "C", second):
            return 1 / (1 - on_a_standing_carrier(second, held))
    return (1 - on_a_standing_carrier(gear.input, gear.held)) / (
        1 - on_a_standing_carrier(gear.output, gear.held)
    )


def far_from_one(internal: Mapping[str, Fraction]) -> bool:
    """Whether no two wheels have nearly the same speed on a standing carrier."""
    return all(abs(1 - a / b) > FAR_FROM_ONE for a, b in permutations(internal.values(), 2))


def assert_turns_as_willis_says(
    element: Mapping[str, Any], internal: Mapping[str, Fraction]
) -> None:
    """Check a set with any link held, solved at its meshes and as three-link mechanisms.

    `internal` are the speeds of its wheels on a standing carrier, see `willis`.
    """
    members = [*internal, "C"]
    for losses in LOSSES:
        document = set_case(element, members, losses=losses)
        results = with_speeds_of_single_meshes(document)
        found = ratios(results)
        for gear in all_held(members):
            expected = willis(internal, gear)
            assert speeds(document, gear.name)[gear.output] == 1 / expected
            assert found[gear.name] == pytest.approx(float(expected), rel=PRECISION), gear.name
        assert found["direct"] == pytest.approx(1, rel=PRECISION)
        assert link_speeds(results, "direct") == pytest.approx(
            dict.fromkeys(results.case.link_names, 1), rel=PRECISION
        )
        ideal = {**element, "mesh_efficiency": NO_LOSS}
        if element["kind"] == "bevel":  # one mechanism, with an efficiency of its own
            ideal = {**element, "efficiency": 1}
        _assert_power_is_conserved(set_case(ideal, members, losses=losses))


def _assert_power_is_conserved(document: Mapping[str, Any]) -> None:
    """Without losses the output torque is the ratio, and nothing is missing."""
    results = solved(document)
    assert results.efficiency == pytest.approx(1, rel=1e-11)
    assert results.output_torque == pytest.approx(results.ratio, rel=1e-11)
    assert results.lossy_torques[..., -1] == pytest.approx(results.ratio, rel=1e-11)
    assert results.power_balance == pytest.approx(0, abs=1e-9)


def wheels_of(kind: str, wheels: Sequence[str], teeth: Teeth) -> dict[str, Any]:
    links = {wheel: LETTERS[wheel] for wheel in wheels}
    return {"kind": kind, **links, "carrier": "C", "teeth": dict(teeth)}


def planetary(teeth: Teeth) -> dict[str, Any]:
    return wheels_of("planetary", ("sun", "ring"), teeth)


def double_planet(teeth: Teeth) -> dict[str, Any]:
    return wheels_of("double_planet", ("sun", "ring"), teeth)


@given(teeth=simple_teeth())
@EXAMPLES
def test_planetary_set(teeth: Teeth) -> None:
    """(w_s - w_c)/(w_r - w_c) = -z_r/z_s."""
    assert_turns_as_willis_says(
        planetary(teeth), {"S": Fraction(1), "R": Fraction(-teeth["sun"], teeth["ring"])}
    )


@given(teeth=simple_teeth())
@EXAMPLES
def test_the_planet_of_a_planetary_set_that_is_one_mechanism(teeth: Teeth) -> None:
    """Against the carrier it turns as z_s/z_p of the sun, backward."""
    document = set_case(planetary(teeth), "SRC", losses="reduced")
    results = solved(document)
    for number, gear in enumerate(results.case.gears):
        exact = speeds(document, gear.name)
        expected = float(exact["P.planet"] - exact["C"])
        assert results.planet_speeds[number] == pytest.approx([expected], rel=PRECISION, abs=1e-11)


@pytest.mark.parametrize(
    ("kind", "teeth", "internal"),
    [
        ("planetary", {"sun": 48, "ring": 96}, {"S": 1, "R": -0.5}),
        ("double_planet", {"sun": 30, "ring": 90}, {"S": 1, "R": Fraction(1, 3)}),
        (
            "ravigneaux",
            {"small_sun": 30, "large_sun": 36, "ring": 72},
            {"s": Fraction(1, 30), "S": Fraction(-1, 36), "R": Fraction(1, 72)},
        ),
        ("bevel", {}, {"L": 1, "R": -1}),
    ],
)
def test_a_set_turns_without_teeth_of_its_planets(
    kind: str, teeth: Teeth, internal: Mapping[str, Fraction]
) -> None:
    """A bevel differential without any is open: the carrier turns at the mean of both sides."""
    members = {LETTERS[wheel]: wheel for wheel in teeth} or {"L": "left", "R": "right"}
    element: dict[str, Any] = {"kind": kind, "carrier": "C"}
    element |= {wheel: link for link, wheel in members.items()}
    element |= {"teeth": teeth} if teeth else {}
    for losses in LOSSES:
        found = ratios(solved(set_case(element, [*members, "C"], losses=losses)))
        for gear in all_held([*members, "C"]):
            expected = pytest.approx(float(willis(internal, gear)), rel=PRECISION)
            assert found[gear.name] == expected, gear.name


@given(teeth=double_teeth())
@EXAMPLES
def test_set_with_meshed_planets(teeth: Teeth) -> None:
    """(w_s - w_c)/(w_r - w_c) = +z_r/z_s."""
    assert_turns_as_willis_says(
        double_planet(teeth), {"S": Fraction(1), "R": Fraction(teeth["sun"], teeth["ring"])}
    )


def stepped_internal(wheels: Sequence[str], teeth: Teeth) -> dict[str, Fraction]:
    """Speeds on a standing carrier when the planet turns at 1: outer meshes turn round."""
    by_hand = {
        "sun": lambda: Fraction(-teeth["planet"], teeth["sun"]),
        "ring": lambda: Fraction(teeth["planet"], teeth["ring"]),
        "sun2": lambda: Fraction(-teeth["planet2"], teeth["sun2"]),
        "ring2": lambda: Fraction(teeth["planet2"], teeth["ring2"]),
    }
    return {LETTERS[wheel]: by_hand[wheel]() for wheel in wheels}


@pytest.mark.slow
@pytest.mark.parametrize("wheels", STEPPED, ids=" ".join)
@given(data=st.data())
@EXAMPLES
def test_set_with_stepped_planets(wheels: Sequence[str], data: st.DataObject) -> None:
    teeth = data.draw(stepped_teeth(wheels))
    internal = stepped_internal(wheels, teeth)
    assume(far_from_one(internal))
    assert_turns_as_willis_says(wheels_of("stepped", wheels, teeth), internal)


@pytest.mark.parametrize("wheels", RAVIGNEAUX, ids=" ".join)
@given(data=st.data())
@EXAMPLES
def test_ravigneaux_set(wheels: Sequence[str], data: st.DataObject) -> None:
    """On a standing carrier the large sun turns against the ring, the small one with it."""
    teeth = data.draw(ravigneaux_teeth())
    of_long_planet = {
        "small_sun": Fraction(teeth["long"], teeth["small_sun"]),
        "large_sun": Fraction(-teeth["long"], teeth["large_sun"]),
        "ring": Fraction(teeth["long"], teeth["ring"]),
    }
    used = {key: value for key, value in teeth.items() if key in (*wheels, "short", "long")}
    internal = {LETTERS[wheel]: of_long_planet[wheel] for wheel in wheels}
    assume(far_from_one(internal))
    assert_turns_as_willis_says(wheels_of("ravigneaux", wheels, used), internal)


@st.composite
def groups(draw: st.DrawFn) -> tuple[dict[str, Any], dict[str, Fraction]]:
    """One to three planets in a chain, of one to three rims, with wheels on any of them.

    Drawn with the speeds of the wheels when the first planet turns at 1, carrier held.
    """
    rims: dict[str, dict[str, int]] = {}
    turned: dict[str, Fraction] = {}
    meshes: list[list[str]] = []
    for planet in "XYZ"[: draw(st.integers(1, 3))]:
        count = draw(st.integers(1, 3))
        rims[planet] = {f"{planet}{n}": draw(st.integers(14, 40)) for n in range(1, count + 1)}
        if not turned:
            turned[planet] = Fraction(1)
            continue
        before = list(rims)[-2]
        first = draw(st.sampled_from(list(rims[before])))
        second = draw(st.sampled_from(list(rims[planet])))
        meshes.append([first, second])
        turned[planet] = -turned[before] * Fraction(rims[before][first], rims[planet][second])
    all_rims = [(planet, rim) for planet, of_planet in rims.items() for rim in of_planet]
    wheels: dict[str, list[dict[str, Any]]] = {"suns": [], "rings": []}
    internal: dict[str, Fraction] = {}
    for number in range(1, draw(st.integers(2, 4)) + 1):
        planet, rim = draw(st.sampled_from(all_rims))
        kind = draw(st.sampled_from(["suns", "rings"]))
        teeth = draw(st.integers(14, 50) if kind == "suns" else st.integers(60, 120))
        wheels[kind].append({"link": f"L{number}", "teeth": teeth, "rim": rim})
        sign = -1 if kind == "suns" else 1
        internal[f"L{number}"] = sign * turned[planet] * Fraction(rims[planet][rim], teeth)
    element = {
        "kind": "planet_group",
        "carrier": "C",
        "rims": rims,
        **{kind: found for kind, found in wheels.items() if found},
        **({"meshes": meshes} if meshes else {}),
    }
    return element, internal


@given(group=groups())
@EXAMPLES
def test_group_of_planets(group: tuple[dict[str, Any], dict[str, Fraction]]) -> None:
    element, internal = group
    assume(far_from_one(internal))
    assert_turns_as_willis_says(element, internal)


@given(teeth=bevel_teeth())
@EXAMPLES
def test_bevel_differential(teeth: Teeth) -> None:
    """(w_left - w_c)/(w_right - w_c) = -z_right/z_left."""
    element = {"kind": "bevel", "left": "L", "right": "R", "carrier": "C", "teeth": dict(teeth)}
    assert_turns_as_willis_says(
        element, {"L": Fraction(1), "R": Fraction(-teeth["left"], teeth["right"])}
    )


@pytest.mark.parametrize("mode", [{}, *({"losses": losses} for losses in LOSSES)])
@given(teeth=st.fixed_dictionaries({"first": WHEELS, "second": WHEELS}))
@EXAMPLES
def test_pairs_of_wheels(mode: dict[str, str], teeth: Teeth) -> None:
    """Outer wheels turn against one another; a wheel in a ring, a chain and a belt do not."""
    assume(teeth["first"] != teeth["second"])  # no wheel turns inside a ring of its own size
    signs = {"gear_pair": -1, "internal_pair": 1, "chain": 1, "belt": 1}
    for kind, sign in signs.items():
        sizes = "diameters" if kind == "belt" else "teeth"
        element = {"kind": kind, "first": "A", "second": "B", sizes: dict(teeth)}
        results = with_speeds_of_single_meshes(pair_case(element, "A", "B", **mode))
        ratio = sign * teeth["second"] / teeth["first"]
        expected = {"forth": ratio, "back": 1 / ratio}
        assert ratios(results) == pytest.approx(expected, rel=PRECISION)


@given(teeth=st.fixed_dictionaries({"first": WHEELS, "idler": WHEELS, "second": WHEELS}))
@EXAMPLES
def test_an_idler_turns_the_sense_and_leaves_the_ratio(teeth: Teeth) -> None:
    element = {"kind": "idler", "first": "A", "second": "B", "teeth": dict(teeth)}
    results = with_speeds_of_single_meshes(pair_case(element, "A", "B"))
    assert ratios(results)["forth"] == pytest.approx(teeth["second"] / teeth["first"], rel=1e-12)


@given(threads=st.integers(1, 6), wheel=st.integers(20, 80))
@EXAMPLES
def test_a_worm_turns_once_for_each_start_of_the_wheel(threads: int, wheel: int) -> None:
    element = {
        "kind": "worm",
        "worm": "A",
        "wheel": "B",
        "teeth": {"worm": threads, "wheel": wheel},
        "efficiency": {"worm": 0.8, "wheel": 0.7},
    }
    results = with_speeds_of_single_meshes(pair_case(element, "A", "B"))
    assert ratios(results)["forth"] == pytest.approx(wheel / threads, rel=PRECISION)
    assert efficiencies(results) == pytest.approx({"forth": 0.8, "back": 0.7}, rel=1e-9)


def test_a_gear_set_can_lose_more_backward() -> None:
    """From sun to carrier (1 + 3 eta)/4; from carrier to sun 4/(1 + 3/eta)."""
    case = (
        "{input: a, output: b, load: {speed: 900 rpm, torque: 90 N*m}, elements: {E: {kind: "
        "planetary, sun: a, ring: housing, carrier: b, teeth: {sun: 30, ring: 90}, %s: 0.9}}, "
        "gears: {low: [], coasting: {coast: true}}}"
    )
    results = solve(loads(case % "efficiency: 0.96, back_efficiency", format="yaml"))
    assert results.efficiency == pytest.approx([(1 + 3 * 0.96) / 4, 4 / (1 + 3 / 0.9)], rel=1e-12)
    with pytest.raises(ReadError, match=r"elements\.E\.back_efficiency: it needs `efficiency`"):
        loads(case % "back_efficiency", format="yaml")


def test_a_shaft_turns_both_ends_alike_and_loses_what_it_says() -> None:
    element = {"kind": "shaft", "first": "A", "second": "B", "efficiency": 0.97}
    results = with_speeds_of_single_meshes(pair_case(element, "A", "B"))
    assert ratios(results) == pytest.approx({"forth": 1, "back": 1}, rel=PRECISION)
    assert efficiencies(results) == pytest.approx({"forth": 0.97, "back": 0.97}, rel=PRECISION)


@pytest.mark.parametrize("losses", LOSSES)
def test_a_ring_that_stands_for_good(losses: str) -> None:
    """Part of the housing, or held by an element: 1 + 78/30 = 3.6."""
    ring = planetary({"sun": 30, "ring": 78, "planet": 24})
    held = {"P": ring, "H": {"kind": "held", "link": "R"}}
    for links, elements in (("SRC", held), ("SC", {"P": ring | {"ring": "housing"}})):
        document = {"links": [*links], "elements": elements, "gears": {"only": {}}}
        found = ratios(with_speeds_of_single_meshes(document | {"losses": losses}))
        assert found["only"] == pytest.approx(3.6, rel=PRECISION)


CHAINED = (
    ("planetary", {"sun": 30, "ring": 78, "planet": 24}, EXTERNAL * INTERNAL),
    ("double_planet", {"sun": 30, "inner": 20, "outer": 20, "ring": 90}, EXTERNAL**2 * INTERNAL),
)


@pytest.mark.parametrize(("kind", "teeth", "expected"), CHAINED)
@pytest.mark.parametrize("losses", LOSSES)
def test_carrier_held_a_set_loses_at_every_mesh(
    kind: str, teeth: dict[str, int], expected: float, losses: str
) -> None:
    element = planetary(teeth) if kind == "planetary" else double_planet(teeth)
    found = efficiencies(solved(set_case(element, "SRC", losses=losses)))
    assert found["S to R, C held"] == pytest.approx(expected, rel=1e-9)
    assert found["R to S, C held"] == pytest.approx(expected, rel=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("wheels", STEPPED, ids=" ".join)
def test_carrier_held_stepped_planets_lose_at_both_wheels(wheels: Sequence[str]) -> None:
    teeth = {"sun": 20, "sun2": 33, "ring": 97, "ring2": 83, "planet": 26, "planet2": 31}
    used = {wheel: teeth[wheel] for wheel in (*wheels, "planet", "planet2")}
    links = [LETTERS[wheel] for wheel in wheels]
    case = set_case(wheels_of("stepped", wheels, used), [*links, "C"], losses="meshes")
    found = efficiencies(solved(case))
    mesh = {"S": EXTERNAL, "S2": EXTERNAL, "R": INTERNAL, "R2": INTERNAL}
    for first in links:
        for second in links:
            if first != second:
                expected = pytest.approx(mesh[first] * mesh[second], rel=1e-9)
                assert found[f"{first} to {second}, C held"] == expected


def test_carrier_held_a_ravigneaux_set_loses_at_every_mesh_on_the_way() -> None:
    """Small sun, short planet, long planet, ring or large sun.

    Three-link mechanisms cannot have it so for all pairs of three wheels at once.
    """
    teeth = {"small_sun": 30, "large_sun": 36, "ring": 72, "short": 20, "long": 18}
    element = wheels_of("ravigneaux", ("small_sun", "large_sun", "ring"), teeth)
    found = efficiencies(solved(set_case(element, ("s", "S", "R", "C"), losses="meshes")))
    expected = {
        "s to R, C held": EXTERNAL**2 * INTERNAL,
        "S to R, C held": EXTERNAL * INTERNAL,
        "s to S, C held": EXTERNAL**3,
    }
    assert {gear: found[gear] for gear in expected} == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("kind", ["planetary", "double_planet", "stepped"])
@given(data=st.data())
@EXAMPLES
def test_a_set_of_two_wheels_loses_the_same_at_its_meshes_as_in_one(
    kind: str, data: st.DataObject
) -> None:
    """All power of one wheel against the carrier goes through every mesh to the other one."""
    if kind == "planetary":
        element, members = planetary(data.draw(simple_teeth())), ["S", "R", "C"]
    elif kind == "double_planet":
        element, members = double_planet(data.draw(double_teeth())), ["S", "R", "C"]
    else:
        wheels = data.draw(st.sampled_from([pair for pair in STEPPED if len(pair) == 2]))
        teeth = data.draw(stepped_teeth(wheels))
        assume(far_from_one(stepped_internal(wheels, teeth)))
        element = wheels_of("stepped", wheels, teeth)
        members = [*(LETTERS[wheel] for wheel in wheels), "C"]
    at_meshes, reduced = (
        efficiencies(solved(set_case(element, members, losses=losses))) for losses in LOSSES
    )
    assert at_meshes == pytest.approx(reduced, rel=1e-9, nan_ok=True)


@pytest.mark.parametrize(
    ("kind", "expected"),
    [("gear_pair", EXTERNAL), ("internal_pair", INTERNAL), ("idler", EXTERNAL**2)],
)
def test_a_pair_loses_at_its_meshes(kind: str, expected: float) -> None:
    teeth = {"first": 20, "second": 41} | ({"idler": 17} if kind == "idler" else {})
    element = {"kind": kind, "first": "A", "second": "B", "teeth": teeth}
    found = efficiencies(solved(pair_case(element, "A", "B")))
    assert found == pytest.approx({"forth": expected, "back": expected}, rel=1e-9)


def test_single_meshes_leave_out_what_is_open_and_refuse_what_contradicts() -> None:
    """With nothing held a planetary set has no speed but the input's."""
    document = set_case(planetary({"sun": 30, "ring": 78}), "SRC")
    document["gears"] |= {"free": {}, "blocked": {"engaged": ["brake S", "brake R"]}}
    assert speeds(document, "free") == {"S": 1}
    with pytest.raises(ContradictionError):
        speeds(document, "blocked")
