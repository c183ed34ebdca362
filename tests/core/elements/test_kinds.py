"""Every kind of element turns as its single meshes say, and as Willis says.

Two ways to the expected speeds, neither of the program: exact fractions from the meshes
of every wheel and planet (`single_meshes`), and the textbook formulas by hand in the tests.
In the formulas a pair of wheels has the internal ratio k = (w_a - w_c)/(w_b - w_c).
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import permutations
from typing import Any

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from tests.chance import count
from tests.core.elements.element_cases import (
    PRECISION,
    Held,
    all_held,
    efficiencies,
    link_speeds,
    pair_case,
    ratios,
    set_case,
    solved,
    with_speeds_of_single_meshes,
)
from tests.oracle.single_meshes import ContradictionError, speeds
from vstatics import ReadError, loads, solve

Teeth = Mapping[str, int]

LOSSES = ("meshes", "reduced")
LETTERS = {"sun": "S", "ring": "R", "sun2": "S2", "ring2": "R2", "small_sun": "s", "large_sun": "S"}
"""The link of each wheel in the small cases."""
STEPPED = (
    *(("sun", "sun2"), ("sun", "ring2"), ("ring", "ring2"), ("ring", "sun2")),
    *(("sun", "ring", "ring2"), ("sun", "ring", "sun2"), ("sun", "sun2", "ring2")),
    *(("ring", "sun2", "ring2"),),
)
RAVIGNEAUX = (
    *(("small_sun", "large_sun"), ("small_sun", "ring"), ("large_sun", "ring")),
    ("small_sun", "large_sun", "ring"),
)
"""Two or three wheels of a set."""

EXTERNAL, INTERNAL = 0.98, 0.99
"""Efficiencies of meshes when nothing is said."""
FAR_FROM_ONE = Fraction(1, 50)
"""An internal ratio of 1 makes one piece of a set; near it digits are lost."""
NO_LOSS = {"external": 1, "internal": 1}
WHEELS = st.integers(12, 90)

EXAMPLES = settings(max_examples=count(4, 30))


def willis(internal: Mapping[str, Fraction], gear: Held) -> Fraction:
    """The ratio of a gear by Willis's equation.

    `internal` are the speeds of the wheels for a speed 1 of any one of them, the carrier held.
    """
    match gear:
        case Held("C", first, second):
            return internal[first] / internal[second]
        case Held(held, first, "C"):
            return 1 - internal[first] / internal[held]
        case Held(held, "C", second):
            return 1 / (1 - internal[second] / internal[held])
        case Held(held, first, second):
            return (internal[held] - internal[first]) / (internal[held] - internal[second])


def assert_turns_as_willis_says(element: dict[str, Any], internal: dict[str, Fraction]) -> None:
    """Check a set with any link held, solved at its meshes and as three-link mechanisms.

    `internal` are the speeds of its wheels on a standing carrier, see `willis`. Without losses the
    output torque is the ratio, and nothing is missing.
    """
    members = [*internal, "C"]
    for losses in LOSSES:
        document = set_case(element, members, losses=losses)
        results = with_speeds_of_single_meshes(document)
        found = ratios(results)
        for number, gear in enumerate(all_held(members)):
            expected, exact = willis(internal, gear), speeds(document, gear.name)
            assert exact[gear.output] == 1 / expected
            assert found[gear.name] == pytest.approx(float(expected), rel=PRECISION), gear.name
            if (element["kind"], losses) == ("planetary", "reduced"):  # one mechanism
                planet = [float(exact["P.planet"] - exact["C"])]
                assert results.planet_speeds[number] == pytest.approx(planet, abs=1e-11), gear.name
        assert found["direct"] == pytest.approx(1, rel=PRECISION)
        as_one = dict.fromkeys(results.case.link_names, 1)
        assert link_speeds(results, "direct") == pytest.approx(as_one, rel=PRECISION)
        # one mechanism, with an efficiency of its own
        none = {"efficiency": 1} if element["kind"] == "bevel" else {"mesh_efficiency": NO_LOSS}
        ideal = solved(set_case({**element, **none}, members, losses=losses))
        assert ideal.efficiency == pytest.approx(1, rel=1e-11)
        assert ideal.output_torque == pytest.approx(ideal.ratio, rel=1e-11)
        assert ideal.lossy_torques[..., -1] == pytest.approx(ideal.ratio, rel=1e-11)
        assert ideal.power_balance == pytest.approx(0, abs=1e-9)


Set = tuple[dict[str, Any], dict[str, Fraction]]
"""An element, and the speeds of its wheels on a standing carrier."""


def wheels_of(kind: str, wheels: Sequence[str], teeth: Teeth) -> dict[str, Any]:
    links = {wheel: LETTERS[wheel] for wheel in wheels}
    return {"kind": kind, **links, "carrier": "C", "teeth": dict(teeth)}


def two_wheels(kind: str, teeth: Teeth) -> Set:
    """(w_s - w_c)/(w_r - w_c) = -z_r/z_s, with meshed planets +z_r/z_s."""
    sign = 1 if kind == "double_planet" else -1
    internal = {"S": Fraction(1), "R": Fraction(sign * teeth["sun"], teeth["ring"])}
    return wheels_of(kind, ("sun", "ring"), teeth), internal


def stepped(wheels: Sequence[str], teeth: Teeth) -> Set:
    """On a standing carrier the planet turns at 1: outer meshes turn round."""
    internal = {}
    for wheel in wheels:
        rim = teeth["planet2" if wheel.endswith("2") else "planet"]
        sign = 1 if wheel.startswith("ring") else -1
        internal[LETTERS[wheel]] = Fraction(sign * rim, teeth[wheel])
    return wheels_of("stepped", wheels, teeth), internal


def ravigneaux(wheels: Sequence[str], teeth: Teeth) -> Set:
    """On a standing carrier the large sun turns against the ring, the small one with it."""
    signs = {"small_sun": 1, "large_sun": -1, "ring": 1}
    used = {key: value for key, value in teeth.items() if key in (*wheels, "short", "long")}
    internal = {LETTERS[w]: Fraction(signs[w] * teeth["long"], teeth[w]) for w in wheels}
    return wheels_of("ravigneaux", wheels, used), internal


def test_a_set_turns_without_teeth_of_its_planets() -> None:
    """A bevel differential without any is open: the carrier turns at the mean of both sides."""
    three = {"small_sun": 30, "large_sun": 36, "ring": 72}
    of_three, by_long = ravigneaux([*three], three | {"long": 1})
    one = {"kind": "bevel", "left": "L", "right": "R", "carrier": "C"}
    for element, internal in (
        two_wheels("planetary", {"sun": 48, "ring": 96}),
        two_wheels("double_planet", {"sun": 30, "ring": 90}),
        (of_three | {"teeth": three}, by_long),
        (one, {"L": Fraction(1), "R": Fraction(-1)}),
    ):
        for losses in LOSSES:
            found = ratios(solved(set_case(element, [*internal, "C"], losses=losses)))
            for gear in all_held([*internal, "C"]):
                expected = pytest.approx(float(willis(internal, gear)), rel=PRECISION)
                assert found[gear.name] == expected, gear.name


@st.composite
def groups(draw: st.DrawFn) -> Set:
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
    element: dict[str, Any] = {"kind": "planet_group", "carrier": "C", "rims": rims}
    element |= {"meshes": meshes} if meshes else {}
    internal: dict[str, Fraction] = {}
    for number in range(1, draw(st.integers(2, 4)) + 1):
        planet, rim = draw(st.sampled_from(all_rims))
        kind, sign = draw(st.sampled_from([("suns", -1), ("rings", 1)]))
        teeth = draw(st.integers(14, 50) if kind == "suns" else st.integers(60, 120))
        element.setdefault(kind, []).append({"link": f"L{number}", "teeth": teeth, "rim": rim})
        internal[f"L{number}"] = sign * turned[planet] * Fraction(rims[planet][rim], teeth)
    return element, internal


@st.composite
def planetary_sets(draw: st.DrawFn) -> Set:
    sun, planet = draw(st.integers(14, 60)), draw(st.integers(14, 40))
    return two_wheels("planetary", {"sun": sun, "ring": sun + 2 * planet, "planet": planet})


@st.composite
def double_sets(draw: st.DrawFn) -> Set:
    """Meshed planets that clear the wheels which they do not mesh with."""
    sun, inner, outer = (draw(st.integers(14, 40)) for _ in range(3))
    lowest, highest = sun + 2 * max(inner, outer) + 5, sun + 2 * inner + 2 * outer
    ring = draw(st.integers(lowest, highest - 1))
    return two_wheels("double_planet", {"sun": sun, "inner": inner, "outer": outer, "ring": ring})


@st.composite
def stepped_sets(draw: st.DrawFn, choices: Sequence[Sequence[str]]) -> Set:
    """Rims of any modules, so that no sum of teeth has to agree."""
    wheels, ranges = draw(st.sampled_from(choices)), {"sun": (14, 50), "ring": (60, 120)}
    ends = {name: ranges.get(name.removesuffix("2"), (14, 45)) for name in wheels}
    ends |= dict.fromkeys(("planet", "planet2"), (14, 45))
    return stepped(wheels, {name: draw(st.integers(*limits)) for name, limits in ends.items()})


@st.composite
def ravigneaux_sets(draw: st.DrawFn) -> Set:
    """The long planet meets large sun and ring, the short one reaches the small sun."""
    large, long, short = (draw(st.integers(*ends)) for ends in ((24, 50), (14, 30), (14, 30)))
    ring = large + 2 * long
    small = draw(st.integers(max(14, large - 2 * short + 1), ring - 1))
    teeth = {"small_sun": small, "large_sun": large, "ring": ring, "short": short, "long": long}
    return ravigneaux(draw(st.sampled_from(RAVIGNEAUX)), teeth)


@st.composite
def bevel_sets(draw: st.DrawFn) -> Set:
    """(w_left - w_c)/(w_right - w_c) = -z_right/z_left."""
    left, right, planet = (draw(st.integers(*ends)) for ends in ((10, 40), (10, 40), (8, 20)))
    own = {"teeth": {"left": left, "right": right, "planet": planet}}
    element = {"kind": "bevel", "left": "L", "right": "R", "carrier": "C", **own}
    return element, {"L": Fraction(1), "R": Fraction(-left, right)}


SETS: dict[str, st.SearchStrategy[Set]] = {
    "planetary": planetary_sets(),
    "double_planet": double_sets(),
    "stepped pair": stepped_sets(STEPPED[:4]),
    "stepped": stepped_sets(STEPPED[4:]),
    "ravigneaux": ravigneaux_sets(),
    "group": groups(),
    "bevel": bevel_sets(),
}


def is_far_from_one(drawn: Set) -> bool:
    """Whether no two wheels have nearly the same speed on a standing carrier."""
    return all(abs(1 - a / b) > FAR_FROM_ONE for a, b in permutations(drawn[1].values(), 2))


@pytest.mark.parametrize("kinds", [("ravigneaux", "stepped pair", "bevel"), [*SETS]])
@given(data=st.data())
@EXAMPLES
def test_sets_turn_as_willis_says(kinds: Sequence[str], data: st.DataObject) -> None:
    for kind in kinds:
        assert_turns_as_willis_says(*data.draw(SETS[kind].filter(is_far_from_one)))


def pairs(draw: Callable[..., Any]) -> Iterator[tuple[dict[str, Any], float]]:
    """Elements between two links, and their ratios.

    Outer wheels turn against one another; a wheel in a ring, a chain and a belt do not. An idler
    turns the sense and leaves the ratio; a worm turns once for each start of the wheel.
    """
    first, second, idler = draw(WHEELS), draw(WHEELS), draw(WHEELS)
    assume(first != second)  # no wheel turns inside a ring of its own size
    ends, teeth = {"first": "A", "second": "B"}, {"first": first, "second": second}
    signs = {"gear_pair": -1, "internal_pair": 1, "chain": 1, "belt": 1}
    for kind, sign in signs.items():
        sizes = "diameters" if kind == "belt" else "teeth"
        yield {"kind": kind, **ends, sizes: teeth}, sign * second / first
    yield {"kind": "idler", **ends, "teeth": {**teeth, "idler": idler}}, second / first
    worm = {"worm": draw(st.integers(1, 6)), "wheel": second}
    own = {"teeth": worm, "efficiency": {"worm": 0.8, "wheel": 0.7}}
    yield {"kind": "worm", "worm": "A", "wheel": "B", **own}, second / worm["worm"]
    yield {"kind": "shaft", **ends, "efficiency": 0.97}, 1


BOTH_WAYS = {"gear_pair": EXTERNAL, "internal_pair": INTERNAL, "idler": EXTERNAL**2}
BOTH_WAYS |= {"shaft": 0.97, "worm": 0.8}
"""Efficiencies of pairs by their meshes, or as they are given."""


@given(data=st.data())
@EXAMPLES
def test_pairs_turn_by_their_teeth_and_lose_at_their_meshes(data: st.DataObject) -> None:
    for mode in ({}, *({"losses": losses} for losses in LOSSES)):
        for element, ratio in pairs(data.draw):
            results = with_speeds_of_single_meshes(pair_case(element, "A", "B", **mode))
            expected = {"forth": ratio, "back": 1 / ratio}
            assert ratios(results) == pytest.approx(expected, rel=PRECISION)
            forth = BOTH_WAYS.get(element["kind"])
            if forth:
                back = 0.7 if element["kind"] == "worm" else forth
                found = efficiencies(results)
                assert found == pytest.approx({"forth": forth, "back": back}, rel=1e-9)


ALL_TEETH = {"sun": 20, "sun2": 33, "ring": 97, "ring2": 83, "planet": 26, "planet2": 31}
ALL_TEETH |= {"small_sun": 30, "large_sun": 36, "short": 20, "long": 18}


def test_carrier_held_a_set_loses_at_every_mesh() -> None:
    """Of a Ravigneaux set: small sun, short planet, long planet, ring or large sun.

    Three-link mechanisms cannot have it so for all pairs of three wheels at once.
    """
    mesh = {"S": EXTERNAL, "S2": EXTERNAL, "R": INTERNAL, "R2": INTERNAL}
    plain, double = {"sun": 30, "ring": 78, "planet": 24}, {"sun": 30, "ring": 90, "inner": 20}
    cases = [(two_wheels("planetary", plain), one, EXTERNAL * INTERNAL) for one in LOSSES]
    meshed = two_wheels("double_planet", double | {"outer": 20})
    cases += [(meshed, losses, EXTERNAL**2 * INTERNAL) for losses in LOSSES]
    for (element, _), losses, expected in cases:
        found = efficiencies(solved(set_case(element, "SRC", losses=losses)))
        assert found["S to R, C held"] == pytest.approx(expected, rel=1e-9)
        assert found["R to S, C held"] == pytest.approx(expected, rel=1e-9)
    for wheels in STEPPED:
        teeth = {wheel: ALL_TEETH[wheel] for wheel in (*wheels, "planet", "planet2")}
        element, internal = stepped(wheels, teeth)
        found = efficiencies(solved(set_case(element, [*internal, "C"], losses="meshes")))
        for first, second in permutations(internal, 2):
            expected = mesh[first] * mesh[second]
            assert found[f"{first} to {second}, C held"] == pytest.approx(expected, rel=1e-9)
    element, _ = ravigneaux(RAVIGNEAUX[-1], ALL_TEETH | {"ring": 72})
    found = efficiencies(solved(set_case(element, ("s", "S", "R", "C"), losses="meshes")))
    assert found["s to R, C held"] == pytest.approx(EXTERNAL**2 * INTERNAL, rel=1e-9)
    assert found["S to R, C held"] == pytest.approx(EXTERNAL * INTERNAL, rel=1e-9)
    assert found["s to S, C held"] == pytest.approx(EXTERNAL**3, rel=1e-9)


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


def test_a_ring_that_stands_for_good() -> None:
    """Part of the housing, or held by an element: 1 + 78/30 = 3.6."""
    ring, _ = two_wheels("planetary", {"sun": 30, "ring": 78, "planet": 24})
    held = {"P": ring, "H": {"kind": "held", "link": "R"}}
    for links, elements in (("SRC", held), ("SC", {"P": ring | {"ring": "housing"}})):
        document = {"links": [*links], "elements": elements, "gears": {"only": {}}}
        for losses in LOSSES:
            found = ratios(with_speeds_of_single_meshes(document | {"losses": losses}))
            assert found["only"] == pytest.approx(3.6, rel=PRECISION)


@given(data=st.data())
@EXAMPLES
def test_a_set_of_two_wheels_loses_the_same_at_its_meshes_as_in_one(data: st.DataObject) -> None:
    """All power of one wheel against the carrier goes through every mesh to the other one."""
    for kind in ("planetary", "double_planet", "stepped pair"):
        element, internal = data.draw(SETS[kind].filter(is_far_from_one))
        cases = (set_case(element, [*internal, "C"], losses=losses) for losses in LOSSES)
        at_meshes, reduced = (efficiencies(solved(case)) for case in cases)
        assert at_meshes == pytest.approx(reduced, rel=1e-9, nan_ok=True)


def test_single_meshes_leave_out_what_is_open_and_refuse_what_contradicts() -> None:
    """With nothing held a planetary set has no speed but the input's."""
    document = set_case(two_wheels("planetary", {"sun": 30, "ring": 78})[0], "SRC")
    document["gears"] |= {"free": {}, "blocked": {"engaged": ["brake S", "brake R"]}}
    assert speeds(document, "free") == {"S": 1}
    with pytest.raises(ContradictionError):
        speeds(document, "blocked")
