"""Speeds of a case made of elements, from single meshes of its wheels, in exact fractions.

An independent way to the speeds: every wheel and every planet is a body, every mesh is
one linear equation between the pitch velocities of two wheels on a carrier, and all of
them are solved by Gauss elimination over fractions. No ratio of a whole set is used.
"""

from collections.abc import Callable, Iterable, Mapping
from fractions import Fraction
from typing import Any

from tests.oracle.linear import ONE, ZERO, Linear

HOUSING = "housing"
STAND_IN = Fraction(1)
"""Tooth number of planets without a given number; it does not affect the speeds of links."""

Equation = dict[str, Fraction]
"""Factors of the speeds of bodies in an equation whose right side is 0."""

Document = Mapping[str, Any]
"""A case or a part of it, as `yaml.safe_load` gives it."""


class ContradictionError(ValueError):
    """No speeds meet all conditions."""


class Bodies:
    """Bodies that turn, and what ties them together."""

    def __init__(self) -> None:
        """Begin with nothing but the housing."""
        self.equations: list[Equation] = []
        self.names: dict[str, None] = {}
        self.unknown: set[str] = set()
        """Planets whose teeth are not told, so that their speed means nothing."""

    def tie(self, *terms: tuple[str, Fraction | int]) -> None:
        """Let the sum of factors times speeds be 0."""
        row: Equation = {}
        for name, factor in terms:
            self.names.setdefault(name)
            row[name] = row.get(name, ZERO) + factor
        self.equations.append(row)

    def external(
        self, first: str, z1: Fraction, second: str, z2: Fraction, carrier: str = HOUSING
    ) -> None:
        """Two wheels mesh from outside: z1 (w1 - wc) + z2 (w2 - wc) = 0."""
        self.tie((first, z1), (second, z2), (carrier, -z1 - z2))

    def internal(
        self, first: str, z1: Fraction, second: str, z2: Fraction, carrier: str = HOUSING
    ) -> None:
        """One wheel meshes inside the other: z1 (w1 - wc) - z2 (w2 - wc) = 0."""
        self.tie((first, z1), (second, -z2), (carrier, z2 - z1))

    def join(self, first: str, second: str = HOUSING) -> None:
        """Make two bodies one, or hold one."""
        self.tie((first, 1), (second, -1))

    def speeds(self, given: Mapping[str, Fraction | int]) -> dict[str, Fraction]:
        """The speeds of all bodies that are determined; the others are left out.

        Raises
        ------
        ContradictionError
            If the given speeds cannot be.
        """
        held = {HOUSING: 0, **given}
        names = sorted(self.names.keys() | held.keys())
        rows = [*self.equations, *({name: ONE} for name in held)]
        right = [ZERO] * len(self.equations) + [Fraction(speed) for speed in held.values()]
        matrix = [[row.get(name, ZERO) for name in names] for row in rows]
        system = Linear(matrix, right, len(names))
        if not system.consistent:
            raise ContradictionError("the conditions contradict each other")
        found = zip(names, map(system.unknown, range(len(names))), strict=True)
        hidden = self.unknown | {HOUSING}
        return {name: speed for name, speed in found if speed is not None and name not in hidden}


def number(value: Any) -> Fraction:
    """A number of a document: 20, 0.5 or `-41/13`."""
    return Fraction(str(value).replace(" ", ""))


def link(name: Any) -> str:
    """The name of a link of a document; 0 is the housing."""
    return HOUSING if str(name) == "0" else str(name)


CHAINS: Mapping[str, list[str]] = {
    "planetary": ["sun x planet o ring"],
    "double_planet": ["sun x inner x outer o ring"],
    "stepped": ["sun x planet", "ring o planet", "sun2 x planet2", "ring2 o planet2"],
    "ravigneaux": ["small_sun x short x long", "large_sun x long", "ring o long"],
    "gear_pair": ["first x second"],
    "internal_pair": ["first o second"],
    "chain": ["first o second"],
    "belt": ["first o second"],
    "idler": ["first x idler x second"],
}
"""Wheels that mesh from outside (x), or whose rims run the same way (o): one inside the other,
a chain, a belt. What begins with a wheel that an element has not is left out."""
PLANETS = {"planet", "planet2", "inner", "outer", "short", "long", "idler"}


class _Element:
    """One element with its name, teeth and members, and the bodies to add it to."""

    def __init__(self, bodies: Bodies, name: str, content: Document) -> None:
        self.bodies = bodies
        self.name = name
        self.content = content
        self.sizes: Document = content.get("teeth") or content.get("diameters") or {}

    def link(self, member: str) -> str:
        return link(self.content[member])

    def wheel(self, name: str) -> tuple[str, Fraction]:
        """A member or a planet as a body, with its teeth or a stand-in for them.

        Two rims of a planet are one body.
        """
        if name not in PLANETS:
            return self.link(name), number(self.sizes[name])
        body = f"{self.name}.{name.removesuffix('2')}"
        if name in self.sizes:
            return body, number(self.sizes[name])
        self.bodies.unknown.add(body)
        return body, STAND_IN

    def mesh(self, chain: str) -> None:
        """Add wheels that mesh one after another."""
        wheels, kinds = chain.split()[::2], chain.split()[1::2]
        if wheels[0] in self.content:
            carrier = link(self.content.get("carrier", HOUSING))
            for first, kind, second in zip(wheels, kinds, wheels[1:], strict=False):
                tie = self.bodies.external if kind == "x" else self.bodies.internal
                tie(*self.wheel(first), *self.wheel(second), carrier)


def _planet_group(one: _Element) -> None:
    carrier = one.link("carrier")
    rims = {
        str(rim): (f"{one.name}.{planet}", number(teeth))
        for planet, of_planet in one.content["rims"].items()
        for rim, teeth in of_planet.items()
    }
    for wheel in one.content.get("suns", ()):
        sun = link(wheel["link"]), number(wheel["teeth"])
        one.bodies.external(*sun, *rims[str(wheel["rim"])], carrier)
    for wheel in one.content.get("rings", ()):
        ring = link(wheel["link"]), number(wheel["teeth"])
        one.bodies.internal(*ring, *rims[str(wheel["rim"])], carrier)
    for first, second in one.content.get("meshes", ()):
        one.bodies.external(*rims[str(first)], *rims[str(second)], carrier)


def _bevel(one: _Element) -> None:
    """The planet's axis is radial, so its speed is the spin against the carrier.

    At the left wheel the planet's rim runs along with the wheel, at the right wheel, on
    the other side of its axis, against it.
    """
    carrier, planet = one.link("carrier"), f"{one.name}.planet"
    one.bodies.unknown.add(planet)
    spin = number(one.sizes.get("planet", 1))
    for side, sense in (("left", 1), ("right", -1)):
        teeth = number(one.sizes.get(side, 1))
        one.bodies.tie((one.link(side), teeth), (carrier, -teeth), (planet, -sense * spin))


def _worm(one: _Element) -> None:
    """In one turn of the worm the wheel goes on by as many teeth as the worm has threads."""
    (worm, threads), (wheel, teeth) = one.wheel("worm"), one.wheel("wheel")
    one.bodies.tie((worm, threads), (wheel, -teeth))


KINDS: Mapping[str, Callable[[_Element], None]] = {
    "planet_group": _planet_group,
    "bevel": _bevel,
    "shaft": lambda one: one.bodies.join(one.link("first"), one.link("second")),
    "worm": _worm,
    "held": lambda one: one.bodies.join(one.link("link")),
}


def bodies_of(document: Document) -> Bodies:
    """All bodies of a case, with their meshes; no shift element is engaged."""
    bodies = Bodies()
    for name in document.get("links", ()):
        bodies.names.setdefault(link(name))
    for name, content in document.get("elements", {}).items():
        element = _Element(bodies, str(name), content)
        for chain in CHAINS.get(content["kind"], ()):
            element.mesh(chain)
        if content["kind"] not in CHAINS:
            KINDS[content["kind"]](element)
    for content in document.get("mechanisms", {}).values():
        first, second = link(content["first"]), link(content["second"])
        ratio, third = number(content["ratio"]), link(content.get("third", HOUSING))
        bodies.tie((first, 1), (second, -ratio), (third, ratio - 1))
    return bodies


def members_of(shift_element: Any) -> tuple[str, str]:
    """Both links of a shift element, in the short form or the long one."""
    named = shift_element["links"] if isinstance(shift_element, dict) else shift_element
    first, second = [*map(link, named), HOUSING][:2]
    return first, second


def _entry(part: Mapping[Any, Any], name: str) -> Any:
    """What stands under a name, which YAML may have taken for a number."""
    return next(value for key, value in part.items() if str(key) == name)


def input_of(document: Document, gear: str) -> str:
    """The input link of a gear."""
    content: Document = _entry(document["gears"], gear) or {}
    named = content.get("input", document.get("input"))
    return link(named if named is not None else document["links"][0])


def speeds(
    document: Document, gear: str, freewheels_held: Iterable[str] = ()
) -> dict[str, Fraction]:
    """Speeds in a gear when the input turns at speed 1, of links and planets.

    Parameters
    ----------
    document : mapping
        A case, as `yaml.safe_load` gives it.
    gear : str
        Its name.
    freewheels_held : iterable of str
        The freewheels that hold in this gear; the others overrun.

    Returns
    -------
    dict
        Of the bodies whose speed is determined, planets as `P1.planet`, `P4.short`,
        `P5.A`; without planets whose teeth are not told.

    Raises
    ------
    ContradictionError
        If the input cannot turn.
    """
    content: Document = _entry(document["gears"], gear) or {}
    bodies = bodies_of(document)
    for name in [*content.get("engaged", ()), *freewheels_held]:
        bodies.join(*members_of(_entry(document["shift_elements"], str(name))))
    given: dict[str, Fraction | int] = {input_of(document, gear): 1}
    given |= {link(name): number(speed) for name, speed in content.get("speeds", {}).items()}
    return bodies.speeds(given)
