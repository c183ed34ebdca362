"""Elements with teeth, and what is said of them."""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import combinations

from hypothesis import assume, settings
from hypothesis import strategies as st

from tests.chance import count
from vstatics.core.elements import CentralWheel, Drawing, Element
from vstatics.core.elements.teeth import doubts
from vstatics.core.errors import Problem

RANDOM = settings(max_examples=count(18, 135))


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


TEETH = st.integers(9, 40)


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


def suggestions(problem: Problem) -> list[dict[str, int]]:
    text = problem.message.partition("; nearest ")[2].partition(": ")[2]
    return [
        {name: int(count) for name, count in re.findall(r"(\w+) (\d+)", part.partition("(")[0])}
        for part in text.split(" or ")
        if part
    ]
