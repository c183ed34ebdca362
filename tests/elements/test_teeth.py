"""Teeth that cannot be made or put together are told, with nearby teeth that can.

Expected numbers come from the conditions by hand, or from two simulations of this file:
`goes_in` turns planets tooth by tooth at their places around the axis, `touching` draws
the tip circles. Neither knows the rules that the package checks.
"""

from __future__ import annotations

import cmath
import math
import re
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import combinations

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from vstatics.elements import CentralWheel, Drawing, Element
from vstatics.elements.checks import problems
from vstatics.elements.kinds import KINDS, Planetary
from vstatics.elements.teeth import doubts
from vstatics.errors import Problem

RANDOM = settings(max_examples=45)
MEMBERS = {
    "planetary": ("sun", "ring"),
    "double_planet": ("sun", "ring"),
    "stepped": ("sun", "ring", "sun2", "ring2"),
    "ravigneaux": ("small_sun", "large_sun", "ring"),
    "bevel": ("left", "right"),
}

HALF = Fraction(1, 2)

Wheels = Sequence[tuple[str, int, bool, str]]
"""Name, teeth, whether it is a ring, the rim that it meshes with."""


def element(kind: str, planets: int | None = None, **teeth: float) -> Element:
    wheels = [member for member in MEMBERS.get(kind, teeth) if member in teeth]
    names = [*wheels, "carrier"] if kind in MEMBERS else wheels
    members = {name: link for link, name in enumerate(names, 1)}
    return Element("E", kind, members, teeth, planets=planets)


def group(
    wheels: Wheels,
    rims: Mapping[str, Mapping[str, int]],
    meshes: Sequence[tuple[str, str]] = (),
    planets: int | None = None,
) -> Element:
    central = [CentralWheel(name, link, *rest) for link, (name, *rest) in enumerate(wheels, 1)]  # type: ignore[arg-type]
    members = {"carrier": len(wheels) + 1}
    return Element(
        "E", "planet_group", members, {}, planets, rims=rims, wheels=central, meshes=meshes
    )


UMDM = group(
    [
        ("1", 36, False, "A1"),
        ("4", 34, False, "B2"),
        ("6", 72, True, "A1"),
        ("7", 84, True, "B1"),
        ("8", 74, True, "B2"),
    ],
    {"A": {"A1": 18, "A2": 21}, "B": {"B1": 30, "B2": 20}},
    [("A2", "B1")],
    planets=3,
)
"""A gearbox that is built, with three sets of planets: all its teeth fit."""


def found(*elements: Element) -> list[Problem]:
    return [*doubts(Drawing(9, elements))]


def told(one: Element, word: str) -> list[Problem]:
    return [problem for problem in found(one) if word in problem.message]


def warnings(one: Element) -> list[Problem]:
    return [problem for problem in found(one) if problem.severity == "warning"]


def is_assembled(one: Element) -> bool:
    return not told(one, "assembled")


# Simulations


def goes_in(one: Element, planets: int) -> bool:
    """Whether all planets find tooth spaces, tried tooth by tooth at each place.

    Wheels stand still, the planets of the first place show where their teeth are.
    """
    contacts = Contacts(*parts(one))
    return all(contacts.fit(Fraction(k, planets)) for k in range(planets))


class Contacts:
    """Teeth where wheels and planets meet, angles in turns.

    Where planets stand towards one another does not matter, so that is an angle of no meaning.
    """

    def __init__(
        self,
        wheels: Wheels,
        rims: Mapping[str, Mapping[str, int]],
        meshes: Sequence[tuple[str, str]],
    ) -> None:
        self.teeth = {rim: count for of in rims.values() for rim, count in of.items()}
        self.planet_of = {rim: planet for planet, of in rims.items() for rim in of}
        self.planets = set(rims)
        self.contacts: list[tuple[str, ...]] = [(wheel[3],) for wheel in wheels] + [*meshes]
        self.wheels = wheels

    def offset(self, contact: int, at: Fraction, turned: Mapping[str, Fraction]) -> Fraction:
        """How far tooth and space are apart, in teeth, up to a constant of the contact."""
        rim, *others = self.contacts[contact]
        if others:
            towards = at + Fraction(1, 7)
            other = others[0]
            return self.phase(rim, towards, turned) + self.phase(other, towards + HALF, turned)
        _, count, internal, _ = self.wheels[contact]
        if internal:
            return at * count - self.phase(rim, at, turned)
        return at * count + self.phase(rim, at + HALF, turned)

    def phase(self, rim: str, towards: Fraction, turned: Mapping[str, Fraction]) -> Fraction:
        """Where in a tooth a rim is in a direction."""
        return (towards - turned[self.planet_of[rim]]) * self.teeth[rim]

    def planets_at(self, contact: int) -> set[str]:
        """Which planets meet a wheel, or one another."""
        return {self.planet_of[rim] for rim in self.contacts[contact]}

    def fit(self, place: Fraction, turned: Mapping[str, Fraction] | None = None) -> bool:
        """Whether planets can be turned so that they fit, those that are not turned yet."""
        known = dict(turned or {})
        for contact in range(len(self.contacts)):
            new = self.planets_at(contact) - known.keys()
            if len(new) == 1:
                (planet,) = new
                trials = (known | {planet: turn} for turn in self.turns(contact, place, known))
                return any(
                    self.matches(place, trial) and self.fit(place, trial) for trial in trials
                )
        return True

    def turns(
        self, contact: int, place: Fraction, known: Mapping[str, Fraction]
    ) -> Iterator[Fraction]:
        """Every way to turn a planet so that it fits at one contact, tooth by tooth."""
        (planet,) = self.planets_at(contact) - known.keys()
        still = self.offset(contact, place, {**known, planet: Fraction(0)})
        once = self.offset(contact, place, {**known, planet: Fraction(1)})
        wanted = self.offset(contact, Fraction(0), dict.fromkeys(self.planets, Fraction(0)))
        for tooth in range(abs(int(once - still))):
            yield (wanted + tooth - still) / (once - still)

    def matches(self, place: Fraction, turned: Mapping[str, Fraction]) -> bool:
        """Whether every contact of planets that are turned is as at the first place."""
        at_rest = dict.fromkeys(self.planets, Fraction(0))
        return all(
            (
                self.offset(contact, place, turned) - self.offset(contact, Fraction(0), at_rest)
            ).denominator
            == 1
            for contact in range(len(self.contacts))
            if self.planets_at(contact) <= turned.keys()
        )


def parts(
    one: Element,
) -> tuple[Wheels, Mapping[str, Mapping[str, int]], Sequence[tuple[str, str]]]:
    """An element as wheels, rims and meshes, written down here once more."""
    if one.rims:
        return [(w.member, w.teeth, w.internal, w.rim) for w in one.wheels], one.rims, one.meshes
    rims, planets, meshes = {
        "planetary": ({"sun": "planet", "ring": "planet"}, [["planet"]], []),
        "double_planet": (
            {"sun": "inner", "ring": "outer"},
            [["inner"], ["outer"]],
            [("inner", "outer")],
        ),
        "stepped": (
            {"sun": "planet", "ring": "planet", "sun2": "planet2", "ring2": "planet2"},
            [["planet", "planet2"]],
            [],
        ),
        "ravigneaux": (
            {"small_sun": "short", "large_sun": "long", "ring": "long"},
            [["short"], ["long"]],
            [("short", "long")],
        ),
    }[one.kind]
    teeth = {name: int(count) for name, count in one.teeth.items()}
    wheels = [(n, teeth[n], "ring" in n, rim) for n, rim in rims.items() if n in teeth]
    return wheels, {p[0]: {rim: teeth[rim] for rim in p} for p in planets}, meshes


def touching(one: Element, planets: int) -> bool:
    """Whether tip circles of a set with meshed planets meet that are not to mesh."""
    t = one.teeth
    inner, outer = (t["sun"] + t["inner"]) / 2, (t["ring"] - t["outer"]) / 2
    apart = (t["inner"] + t["outer"]) / 2
    angle = math.acos((inner**2 + outer**2 - apart**2) / (2 * inner * outer))
    places = [2 * math.pi * k / planets for k in range(planets)]
    circles = [(k, cmath.rect(inner, at), t["inner"] / 2 + 1) for k, at in enumerate(places)]
    circles += [
        (k, cmath.rect(outer, at + angle), t["outer"] / 2 + 1) for k, at in enumerate(places)
    ]
    return any(
        a != b and abs(first - second) <= r + s + 1e-9
        for (a, first, r), (b, second, s) in combinations(circles, 2)
    )


# Assembly


def test_planets_go_in_where_sun_and_ring_add_up_to_a_multiple_of_them() -> None:
    assert is_assembled(element("planetary", 3, sun=48, ring=96, planet=24))
    (problem,) = told(element("planetary", 3, sun=48, ring=97, planet=24), "assembled")
    assert "(sun + ring)/planets = 145/3 is not whole" in problem.message
    assert problem.path == ("elements", 1, "planets")
    assert problem.severity == "warning"


def test_meshed_planets_go_in_where_the_difference_is_a_multiple_of_them() -> None:
    assert is_assembled(element("double_planet", 3, sun=30, inner=20, outer=20, ring=90))
    (problem,) = told(element("double_planet", 3, sun=30, ring=91), "assembled")
    assert "(ring - sun)/planets = 61/3 is not whole" in problem.message


@pytest.mark.parametrize(
    ("planets", "formula"),
    [
        # (30 * 25 + 95 * 20)/gcd(20, 25) = 530
        (2, ""),
        (5, ""),
        (3, "(sun * planet2 + ring2 * planet)/(planets * gcd(planet, planet2)) = 2650/15"),
        (4, "(sun * planet2 + ring2 * planet)/(planets * gcd(planet, planet2)) = 2650/20"),
    ],
)
def test_stepped_planets_go_in_by_the_rims_that_they_join(planets: int, formula: str) -> None:
    doubtful = told(
        element("stepped", planets, sun=30, planet=20, planet2=25, ring2=95), "assembled"
    )
    assert [formula in problem.message for problem in doubtful] == ([True] if formula else [])


def test_ravigneaux_planets_go_in_by_both_suns() -> None:
    teeth = {"small_sun": 30, "large_sun": 36, "ring": 72, "short": 20, "long": 18}
    assert is_assembled(element("ravigneaux", 3, **teeth))
    (problem,) = told(element("ravigneaux", 3, **teeth | {"small_sun": 31}), "assembled")
    assert "(small_sun + large_sun)/planets = 67/3 is not whole" in problem.message
    del teeth["small_sun"]
    (problem,) = told(element("ravigneaux", 3, **teeth | {"large_sun": 35}), "assembled")
    assert "(large_sun + ring)/planets = 107/3 is not whole" in problem.message


def test_a_gearbox_that_is_built_can_be_assembled() -> None:
    assert not warnings(UMDM)
    assert goes_in(UMDM, 3)
    assert not is_assembled(replace(UMDM, planets=4))
    assert not goes_in(UMDM, 4)


def test_bevel_planets_go_in_where_both_sides_add_up_to_a_multiple_of_them() -> None:
    assert is_assembled(element("bevel", 4, left=16, right=16, planet=10))
    (problem,) = told(element("bevel", 3, left=16, right=16, planet=10), "assembled")
    assert "(left + right)/planets = 32/3 is not whole" in problem.message
    assert "left 15, planet 10, right 15 (ratio -1)" in problem.message


TEETH = st.integers(9, 40)


@RANDOM
@given(st.data(), st.integers(2, 5))
def test_planets_can_be_assembled_where_turning_them_tooth_by_tooth_finds_a_way(
    data: st.DataObject, planets: int
) -> None:
    one = data.draw(st.one_of(planetary(), double_planet(), stepped(), ravigneaux(), groups()))
    one = replace(one, planets=planets)
    assert is_assembled(one) == goes_in(one, planets)


@st.composite
def planetary(draw: st.DrawFn) -> Element:
    sun, planet = draw(TEETH), draw(TEETH)
    return element(
        "planetary", sun=sun, planet=planet, ring=sun + 2 * planet + draw(st.integers(-1, 1))
    )


@st.composite
def double_planet(draw: st.DrawFn) -> Element:
    sun, inner, outer = draw(TEETH), draw(TEETH), draw(TEETH)
    ring = sun + 2 * max(inner, outer) + draw(st.integers(1, 2 * min(inner, outer)))
    return element("double_planet", sun=sun, inner=inner, outer=outer, ring=ring)


@st.composite
def stepped(draw: st.DrawFn) -> Element:
    """Sun or ring or both at each rim: all kinds of stepped planets."""
    teeth = {"planet": draw(TEETH), "planet2": draw(TEETH)}
    center = max(teeth.values()) + draw(TEETH)
    wheels = draw(st.sets(st.sampled_from(MEMBERS["stepped"]), min_size=2))
    for wheel in wheels:
        rim = "planet2" if wheel.endswith("2") else "planet"
        sign = 1 if wheel.startswith("ring") else -1
        teeth[wheel] = center + sign * teeth[rim]
    assume(min(teeth.values()) > 2)
    assume({"planet", "planet2"} == {("planet2" if w.endswith("2") else "planet") for w in wheels})
    return element("stepped", **teeth)


@st.composite
def ravigneaux(draw: st.DrawFn) -> Element:
    large, long, short, less = draw(TEETH), draw(TEETH), draw(TEETH), draw(st.integers(0, 8))
    return element(
        "ravigneaux",
        small_sun=max(large - less, 5),
        large_sun=large,
        ring=large + 2 * long,
        short=short,
        long=long,
    )


@st.composite
def groups(draw: st.DrawFn) -> Element:
    """Two planets of two rims each, meshed, with a few wheels around."""
    few = st.integers(6, 14)
    rims = {"A": {"A1": draw(few), "A2": draw(few)}, "B": {"B1": draw(few), "B2": draw(few)}}
    teeth = {rim: count for of in rims.values() for rim, count in of.items()}
    wheels = [
        (
            str(number),
            draw(st.integers(20, 60)),
            draw(st.booleans()),
            draw(st.sampled_from([*teeth])),
        )
        for number in range(draw(st.integers(2, 4)))
    ]
    return group(wheels, rims, [("A2", "B1")])


# One axis


def test_a_ring_holds_the_sun_and_two_planets() -> None:
    assert not told(element("planetary", sun=48, ring=96, planet=24), "ring 96 is not")
    (close,) = told(
        element("planetary", sun=48, ring=98, planet=24), "ring 98 is not sun + 2 planet = 96"
    )
    assert close.severity == "note"
    assert "shifted profiles" in close.message
    (far,) = told(
        element("planetary", sun=48, ring=99, planet=24), "ring 99 is not sun + 2 planet = 96"
    )
    assert far.severity == "warning"
    assert far.path == ("elements", 1, "teeth", "ring")


def test_half_a_tooth_is_left_for_planets_between_odd_wheels() -> None:
    assert not told(element("planetary", sun=48, ring=96), "standard planet")
    (problem,) = told(element("planetary", sun=48, ring=97), "no standard planet fits between")
    assert problem.severity == "note"
    assert (
        "(ring - sun)/2 = 24.5 is not whole; speeds of planets take it as it is" in problem.message
    )


def test_long_planets_of_a_ravigneaux_set_fit_the_large_sun_and_the_ring() -> None:
    teeth = {"small_sun": 30, "large_sun": 36, "ring": 72, "short": 20, "long": 18}
    assert not told(element("ravigneaux", **teeth), "large_sun + 2 long")
    (problem,) = told(
        element("ravigneaux", **teeth | {"ring": 80}), "ring 80 is not large_sun + 2 long = 72"
    )
    assert problem.severity == "warning"
    (problem,) = told(
        element("ravigneaux", small_sun=30, large_sun=36, ring=30), "no planet `long` fits"
    )
    assert problem.path == ("elements", 1, "teeth", "ring")


def test_wheels_of_one_rim_of_a_group_stand_on_one_axis() -> None:
    other = replace(UMDM, wheels=[*UMDM.wheels[:4], CentralWheel("8", 5, 79, True, "B2")])
    (problem,) = told(other, "ring `8` 79 is not sun `4` + 2 rim `B2` = 74")
    assert problem.path == ("elements", 1, "rings", 3, "teeth")
    assert problem.severity == "warning"


def test_rims_of_different_radius_need_different_modules() -> None:
    assert not told(element("stepped", sun=30, planet=20, planet2=25, ring2=75), "module")
    # 25 + 20 = 45 and 61 - 25 = 36; 45/36 = 1.25
    (problem,) = told(element("stepped", sun=25, planet=20, planet2=25, ring2=61), "module")
    assert "that of planet2 is 1.25 times that of planet (5/4)" in problem.message
    assert problem.severity == "note"
    assert problem.path == ("elements", 1, "teeth", "planet2")


def test_rims_of_almost_one_radius_need_shifted_profiles() -> None:
    """A Wolfrom set: 100 - 40 = 60 and 97 - 38 = 59."""
    teeth = {"sun": 20, "ring": 100, "ring2": 97, "planet": 40, "planet2": 38}
    (problem,) = told(element("stepped", **teeth), "module")
    assert problem.message == (
        "coaxial with shifted profiles, or with different modules: "
        "that of planet2 is 1.0169 times that of planet (60/59)"
    )


def test_meshed_planets_reach_one_another() -> None:
    assert not told(element("double_planet", sun=30, inner=20, outer=20, ring=90), "can't mesh")
    # Radii (30 + 20)/2 = 25 and (120 - 20)/2 = 50 leave 25 between, planets make 20.
    (problem,) = told(element("double_planet", sun=30, inner=20, outer=20, ring=120), "can't mesh")
    assert "distance 20 would have to lie between 25 and 75" in problem.message
    assert problem.path == ("elements", 1, "teeth", "inner")


def test_meshed_planets_pass_the_wheel_that_they_dont_mesh_with() -> None:
    # The tips of the inner planet reach to 30 + 28 + 28 + 2 = 88, twice the radius in modules;
    # those of a ring of 90 stand at 88 too, those of one of 91 leave a gap.
    assert told(
        element("double_planet", sun=30, inner=28, outer=20, ring=90), "inner 28 and ring 90"
    )
    assert not told(element("double_planet", sun=30, inner=28, outer=20, ring=91), "inner 28 and")
    assert told(
        element("double_planet", sun=30, inner=29, outer=20, ring=90), "inner 29 and ring 90"
    )
    assert told(
        element("double_planet", sun=30, inner=20, outer=29, ring=90), "outer 29 and sun 30"
    )


# Neighbours


@pytest.mark.parametrize(("planets", "limit"), [(3, 13.93), (4, 5.83), (5, 3.85), (6, 3.0)])
def test_neighbours_touch_beyond_the_known_ratio_of_large_sets(planets: int, limit: float) -> None:
    """(1 + sin(pi/n))/(1 - sin(pi/n)): the tips hardly count where there are so many teeth."""
    sun = 60000
    for ratio, expected in ((limit - 0.02, 0), (limit + 0.02, 1)):
        planet = round((ratio - 1) / 2 * sun)
        one = element("planetary", planets, sun=sun, planet=planet, ring=sun + 2 * planet)
        assert len(told(one, "touch")) == expected


def test_tips_of_neighbours_are_told_with_their_distance() -> None:
    assert not told(element("planetary", 4, sun=20, ring=100, planet=40), "touch")  # 42.43 > 42
    (problem,) = told(element("planetary", 5, sun=20, ring=100, planet=40), "touch")
    assert (
        "(sun + planet) sin(180°/5) = 35.27, expected more than planet + 2 = 42" in problem.message
    )
    assert "; 3 or 4 planets fit" in problem.message
    assert not told(element("planetary", sun=20, ring=100, planet=40), "touch")


def test_the_larger_rim_of_stepped_planets_touches_first() -> None:
    teeth = {"sun": 30, "planet": 20, "planet2": 40, "ring2": 90}
    assert not told(element("stepped", 3, **teeth), "touch")  # 50 * 0.866 = 43.3 > 42
    (problem,) = told(
        element("stepped", 4, **teeth), "touch"
    )  # 35.4, and 22 would do for the other
    assert "expected more than planet2 + 2 = 42" in problem.message


@RANDOM
@given(double_planet(), st.integers(2, 6))
def test_meshed_planets_touch_where_their_tip_circles_meet(one: Element, planets: int) -> None:
    teeth = one.teeth
    inner, outer = teeth["sun"] + teeth["inner"], teeth["ring"] - teeth["outer"]
    assume(abs(inner - outer) < teeth["inner"] + teeth["outer"] < inner + outer)
    assert bool(told(replace(one, planets=planets), "neighbouring planets")) == touching(
        one, planets
    )


# Profiles, wear


@pytest.mark.parametrize(
    ("teeth", "severity"), [(13, "warning"), (14, "note"), (16, "note"), (17, None)]
)
def test_few_teeth_are_undercut(teeth: int, severity: str | None) -> None:
    for one in (
        element("gear_pair", first=41, second=teeth),
        element("idler", first=37, idler=teeth, second=41),
        element("internal_pair", first=teeth, second=61),
        element("planetary", sun=teeth, planet=20, ring=teeth + 40),
        element("planetary", sun=23, ring=23 + 2 * teeth),
        element("ravigneaux", small_sun=teeth, large_sun=29, ring=67),
        element("idler", first=teeth, second=41),
    ):
        doubtful = [p for p in found(one) if "undercut" in p.message]
        assert [problem.severity for problem in doubtful] == ([severity] if severity else [])


def test_tips_interfere_in_a_ring_that_is_hardly_larger() -> None:
    assert not told(element("internal_pair", first=40, second=48), "interfere")
    for pair in ({"first": 40, "second": 47}, {"first": 47, "second": 40}):
        (problem,) = told(element("internal_pair", **pair), "interfere")
        assert problem.severity == "warning"
        assert "the ring has 7 teeth more, expected 8 or more" in problem.message
    assert told(element("planetary", sun=5, planet=40, ring=45), "interfere")
    assert told(
        element("stepped", sun=20, planet=40, planet2=30, ring2=30),
        "planet2 30 doesn't fit into ring2 30",
    )


@given(st.integers(17, 60), st.integers(17, 60))
def test_teeth_meet_again_after_as_many_turns_as_is_told(first: int, second: int) -> None:
    """Counting tooth by tooth: tooth 0 of both meet again after so many teeth."""
    doubtful = told(element("gear_pair", first=first, second=second), "common divisor")
    passed = next(n for n in range(1, first * second + 1) if n % first == 0 == n % second)
    turns = passed // first
    if turns == second:
        assert not doubtful
        return
    (problem,) = doubtful
    often = "every turn of" if turns == 1 else f"every {turns} turns of"
    assert f"{often} first" in problem.message
    assert problem.severity == "note"


def test_common_divisors_of_an_element_are_told_together() -> None:
    (problem,) = told(element("planetary", 3, sun=48, ring=96, planet=24), "common divisor")
    assert "sun 48 and planet 24 have the common divisor 24" in problem.message
    assert "likewise ring 96 and planet 24 (24)" in problem.message
    assert (
        "nearest without a common divisor: sun 49, ring 95, planet 23 (ratio -1.9388)"
        in problem.message
    )
    assert not told(element("planetary", 3, sun=49, ring=95, planet=23), "common divisor")
    assert not told(element("planetary", sun=48, ring=96, planet=24), "common divisor")


def test_a_chain_wants_more_teeth() -> None:
    (problem,) = found(element("chain", first=16, second=40))
    assert problem.severity == "note"
    assert problem.path == ("elements", 1, "teeth", "first")
    assert not found(element("chain", first=17, second=40))


@pytest.mark.parametrize(
    "one",
    [
        element("belt", first=10, second=10.5),
        element("worm", worm=1, wheel=40),
        element("shaft"),
        element("held"),
        element("bevel"),
        element("planetary", 3, sun=10.5, ring=30),
        element("gear_pair", first=20, second=41),
        element("planetary", sun=49, ring=95),
    ],
    ids=lambda one: one.kind,
)
def test_there_is_nothing_to_say_about(one: Element) -> None:
    assert not found(one)


# What would do


def test_nearby_teeth_are_told_with_their_ratio() -> None:
    (problem,) = told(element("planetary", 3, sun=48, ring=97), "nearest that fit")
    assert problem == found(element("planetary", 3, sun=48, ring=97))[0]  # of two that it cures
    assert problem.message.endswith(
        "; nearest that fit: sun 48, ring 96 (ratio -2) or sun 47, ring 97 (ratio -2.0638)"
    )


def test_a_pair_keeps_its_ratio_where_a_wheel_grows() -> None:
    (problem,) = told(element("gear_pair", first=12, second=41), "undercut")
    assert "; nearest that fit: first 14, second 48 (ratio -3.4286)" in problem.message


def test_of_many_wheels_those_that_change_are_told() -> None:
    other = replace(UMDM, wheels=[*UMDM.wheels[:4], CentralWheel("8", 5, 75, True, "B2")])
    (problem,) = told(other, "nearest that fit")
    # 74/28 = 2.6429 and so on: the published teeth
    assert (
        "; nearest that fit: ring `8` 74 (ratios 2.6429, -2.1765, -1.3214, 1.3214)"
        in problem.message
    )


@RANDOM
@given(st.data(), st.integers(2, 5))
def test_what_is_suggested_passes_every_check(data: st.DataObject, planets: int) -> None:
    one = data.draw(st.one_of(planetary(), double_planet(), stepped(), ravigneaux()))
    one = replace(one, planets=planets)
    for problem in found(one):
        for teeth in suggestions(problem):
            other = replace(one, teeth={**one.teeth, **teeth})
            assert teeth.keys() <= one.teeth.keys()
            assert not warnings(other)
            assert not told(other, "shifted profiles only")
            assert goes_in(other, planets)
            if "without a common divisor" in problem.message:
                assert not told(other, "common divisor")


def suggestions(problem: Problem) -> list[dict[str, int]]:
    text = problem.message.partition("; nearest ")[2].partition(": ")[2]
    return [
        {name: int(count) for name, count in re.findall(r"(\w+) (\d+)", part.partition("(")[0])}
        for part in text.split(" or ")
        if part
    ]


@RANDOM
@given(st.integers(17, 60), st.integers(17, 60), st.integers(3, 5))
def test_nothing_nearer_fits_than_what_is_suggested(sun: int, planet: int, planets: int) -> None:
    """All sets around one that cannot be assembled, by brute force."""
    ring = sun + 2 * planet
    one = element("planetary", planets, sun=sun, ring=ring)
    doubtful = told(one, "assembled")
    assume(doubtful)
    assume(suggestions(doubtful[0]))

    def distance(teeth: Mapping[str, float]) -> float:
        change = math.log(teeth["ring"] / ring) - math.log(teeth["sun"] / sun)
        return abs(teeth["sun"] - sun) + abs(teeth["ring"] - ring) + 100 * abs(change)

    best = min(distance(teeth) for teeth in suggestions(doubtful[0]))
    for s in range(max(sun - 3, 17), sun + 4):
        for r in range(ring - 3, ring + 4):
            if (s + r) % planets == 0 == (r - s) % 2 and distance(
                {"sun": s, "ring": r}
            ) < best - 1e-9:
                p = (r - s) // 2
                assert (s + p) * math.sin(math.pi / planets) <= p + 2 or p < 17


def test_no_doubt_is_an_error_and_elements_count_from_1() -> None:
    bad = element("planetary", 3, sun=10, ring=97, planet=12)
    doubtful = found(element("gear_pair", first=20, second=41), bad)
    assert {problem.path[:2] for problem in doubtful} == {("elements", 2)}
    assert {problem.severity for problem in doubtful} == {"warning", "note"}


@RANDOM
@given(st.data(), st.integers(1, 7))
def test_any_teeth_without_errors_can_be_doubted(data: st.DataObject, planets: int) -> None:
    kind = data.draw(st.sampled_from(["planetary", "double_planet", "stepped", "ravigneaux"]))
    shape = KINDS[kind]
    assert isinstance(shape, Planetary)
    names = data.draw(st.lists(st.sampled_from(shape.toothed), min_size=2, unique=True))
    one = element(kind, planets, **{name: data.draw(st.integers(1, 60)) for name in names})
    assume(not [*problems(Drawing(9, [one]))])
    assert all(problem.severity in ("warning", "note") for problem in found(one))


def test_a_case_of_ten_elements_is_checked_at_once() -> None:
    one = element("planetary", 3, sun=48, ring=97, planet=24)
    start = time.process_time()
    found(*[one] * 10)
    assert time.process_time() - start < 2  # some 40 ms; much more on a busy machine
