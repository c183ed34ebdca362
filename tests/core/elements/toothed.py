"""Elements with teeth, and what is said of them."""

import cmath
import math
import re
from collections.abc import Mapping, Sequence
from fractions import Fraction
from itertools import combinations

from hypothesis import assume, settings
from hypothesis import strategies as st

from tests.chance import count
from tests.oracle.phases import Contact, Group, Wheel, assembles
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


Rims = Mapping[str, Mapping[str, int]]
Wheels = Sequence[tuple[str, int, bool, str]]
"""Name, teeth, whether it is a ring, the rim that it meshes with."""


def element(kind: str, planets: int | None = None, **teeth: float) -> Element:
    wheels = [member for member in MEMBERS.get(kind, teeth) if member in teeth]
    names = [*wheels, "carrier"] if kind in MEMBERS else wheels
    members = {name: link for link, name in enumerate(names, 1)}
    return Element("E", kind, members, teeth, planets=planets)


def of(text: str) -> Element:
    """An element by its kind, planets and teeth: `planetary/3 sun 48 ring 97`."""
    head, *words = text.split()
    kind, _, planets = head.partition("/")
    teeth = {
        name: float(n) if "." in n else int(n)
        for name, n in zip(words[::2], words[1::2], strict=True)
    }
    return element(kind, int(planets) if planets else None, **teeth)


def group(
    wheels: Wheels,
    rims: Rims,
    meshes: Sequence[tuple[str, str]] = (),
    planets: int | None = None,
) -> Element:
    central = [
        CentralWheel(name, link, teeth, is_internal, rim)
        for link, (name, teeth, is_internal, rim) in enumerate(wheels, 1)
    ]
    own = {"carrier": len(wheels) + 1}
    return Element("E", "planet_group", own, {}, planets, rims=rims, wheels=central, meshes=meshes)


UMDM = group(
    [
        *(("1", 36, False, "A1"), ("4", 34, False, "B2"), ("6", 72, True, "A1")),
        *(("7", 84, True, "B1"), ("8", 74, True, "B2")),
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

    The direction from one planet of a set to the next does not matter (`test_phases`).
    """
    wheels, rims, meshes = parts(one)
    line = Fraction(1, 7)
    axes = {planet: number * line for number, planet in enumerate(rims)}
    central = [Wheel(count, rim, internal) for _, count, internal, rim in wheels]
    contacts = [Contact(first, second, line) for first, second in meshes]
    return assembles(Group(rims, axes, central, contacts), planets)


def parts(one: Element) -> tuple[Wheels, Rims, Sequence[tuple[str, str]]]:
    """An element as wheels, rims and meshes, written down here once more."""
    if one.rims:
        return [(w.member, w.teeth, w.internal, w.rim) for w in one.wheels], one.rims, one.meshes
    planets: list[tuple[str, ...]]
    meshes: list[tuple[str, str]] = []
    match one.kind:
        case "planetary":
            places, planets = {"sun": "planet", "ring": "planet"}, [("planet",)]
        case "double_planet":
            places, planets = {"sun": "inner", "ring": "outer"}, [("inner",), ("outer",)]
            meshes = [("inner", "outer")]
        case "stepped":
            places = {"sun": "planet", "ring": "planet", "sun2": "planet2", "ring2": "planet2"}
            planets = [("planet", "planet2")]
        case _:
            places = {"small_sun": "short", "large_sun": "long", "ring": "long"}
            planets, meshes = [("short",), ("long",)], [("short", "long")]
    teeth = {name: int(count) for name, count in one.teeth.items()}
    wheels = [(n, teeth[n], "ring" in n, rim) for n, rim in places.items() if n in teeth]
    return wheels, {p[0]: {rim: teeth[rim] for rim in p} for p in planets}, meshes


def touching(one: Element, planets: int) -> bool:
    """Whether tip circles of a set with meshed planets meet that are not to mesh."""
    t = one.teeth
    inner, outer = (t["sun"] + t["inner"]) / 2, (t["ring"] - t["outer"]) / 2
    apart = (t["inner"] + t["outer"]) / 2
    angle = math.acos((inner**2 + outer**2 - apart**2) / (2 * inner * outer))
    circles = []
    for k in range(planets):
        at = 2 * math.pi * k / planets
        circles.append((k, cmath.rect(inner, at), t["inner"] / 2 + 1))
        circles.append((k, cmath.rect(outer, at + angle), t["outer"] / 2 + 1))
    return any(
        a != b and abs(first - second) <= r + s + 1e-9
        for (a, first, r), (b, second, s) in combinations(circles, 2)
    )


TEETH = st.integers(9, 40)


@st.composite
def planetary(draw: st.DrawFn) -> Element:
    sun, planet, more = draw(TEETH), draw(TEETH), draw(st.integers(-1, 1))
    return element("planetary", sun=sun, planet=planet, ring=sun + 2 * planet + more)


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
    suns = {"small_sun": max(large - less, 5), "large_sun": large}
    return element("ravigneaux", **suns, ring=large + 2 * long, short=short, long=long)


@st.composite
def groups(draw: st.DrawFn) -> Element:
    """Two planets of two rims each, meshed, with a few wheels around."""
    few, rim = st.integers(6, 14), st.sampled_from(["A1", "A2", "B1", "B2"])
    rims = {"A": {"A1": draw(few), "A2": draw(few)}, "B": {"B1": draw(few), "B2": draw(few)}}
    wheels = [
        (str(number), draw(st.integers(20, 60)), draw(st.booleans()), draw(rim))
        for number in range(draw(st.integers(2, 4)))
    ]
    return group(wheels, rims, [("A2", "B1")])


def suggestions(problem: Problem) -> list[dict[str, int]]:
    text = problem.message.partition("; nearest ")[2].partition(": ")[2]
    parts = [part.partition("(")[0] for part in text.split(" or ") if part]
    return [{n: int(count) for n, count in re.findall(r"(\w+) (\d+)", part)} for part in parts]
