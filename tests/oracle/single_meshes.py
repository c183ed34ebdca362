"""Speeds of a case made of elements, from single meshes of its wheels, in exact fractions.

An independent way to the speeds: every wheel and every planet is a body, every mesh is
one linear equation between the pitch velocities of two wheels on a carrier, and all of
them are solved by Gauss elimination over fractions. No ratio of a whole set is used.
"""

from collections.abc import Callable, Iterable, Mapping
from fractions import Fraction
from typing import Any

HOUSING = "housing"
STAND_IN = Fraction(1)
"""Teeth of a planet that are not told; they do not touch the speeds of the links."""

Row = dict[str, Fraction]
"""The speeds of bodies with their factors: an equation, its right side is 0."""

Document = Mapping[str, Any]
"""A case or a part of it, as `yaml.safe_load` gives it."""


class ContradictionError(ValueError):
    """No speeds meet all conditions."""


class Bodies:
    """Bodies that turn, and what ties them together."""

    def __init__(self) -> None:
        """Begin with nothing but the housing."""
        self.equations: list[Row] = []
        self.names: dict[str, None] = {}
        self.unknown: set[str] = set()
        """Planets whose teeth are not told, so that their speed means nothing."""

    def tie(self, *terms: tuple[str, Fraction | int]) -> None:
        """Let the sum of factors times speeds be 0."""
        row: Row = {}
        for name, factor in terms:
            self.names.setdefault(name)
            row[name] = row.get(name, Fraction(0)) + factor
        row.pop(HOUSING, None)
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
        rows = [(dict(row), Fraction(0)) for row in self.equations]
        for name, speed in given.items():
            self.names.setdefault(name)
            rows.append(({name: Fraction(1)}, Fraction(speed)))
        found = _solved(rows)
        found[HOUSING] = Fraction(0)
        return {
            name: found[name] for name in self.names if name in found and name not in self.unknown
        }


def _solved(rows: list[tuple[Row, Fraction]]) -> dict[str, Fraction]:
    """Reduce to echelon form; a body is determined where its row holds no other."""
    pivots: dict[str, tuple[Row, Fraction]] = {}
    for raw in rows:
        row, right = raw
        for name, (other, value) in pivots.items():
            row, right = _less(row, right, other, value, row.get(name, Fraction(0)))
        if not row:
            if right:
                raise ContradictionError("the conditions contradict each other")
            continue
        name, factor = next(iter(row.items()))
        row, right = {key: value / factor for key, value in row.items()}, right / factor
        for key, (other, value) in pivots.items():
            pivots[key] = _less(other, value, row, right, other.get(name, Fraction(0)))
        pivots[name] = row, right
    return {name: right for name, (row, right) in pivots.items() if len(row) == 1}


def _less(
    row: Row, right: Fraction, other: Row, value: Fraction, times: Fraction
) -> tuple[Row, Fraction]:
    """One equation less another one taken some times."""
    if not times:
        return row, right
    result = dict(row)
    for key, factor in other.items():
        result[key] = result.get(key, Fraction(0)) - times * factor
    return {key: factor for key, factor in result.items() if factor}, right - times * value


def number(value: Any) -> Fraction:
    """A number of a document: 20, 0.5 or `-41/13`."""
    return Fraction(str(value).replace(" ", ""))


def link(name: Any) -> str:
    """The name of a link of a document; 0 is the housing."""
    return HOUSING if str(name) == "0" else str(name)


class _Element:
    """One element with its name, teeth and members, and the bodies to add it to."""

    def __init__(self, bodies: Bodies, name: str, content: Document) -> None:
        self.bodies = bodies
        self.name = name
        self.content = content
        self.sizes: Document = content.get("teeth") or content.get("diameters") or {}

    def __contains__(self, member: str) -> bool:
        return member in self.content

    def link(self, member: str) -> str:
        return link(self.content[member])

    def teeth(self, member: str) -> Fraction:
        return number(self.sizes[member])

    def planet(self, name: str) -> tuple[str, Fraction]:
        """A planet as a body, with its teeth or a stand-in for them."""
        body = f"{self.name}.{name}"
        if name in self.sizes:
            return body, self.teeth(name)
        self.bodies.unknown.add(body)
        return body, STAND_IN

    def sun(self, member: str, planet: str) -> None:
        """A central wheel meshes from outside with a planet."""
        self.bodies.external(
            self.link(member), self.teeth(member), *self.planet(planet), self.link("carrier")
        )

    def ring(self, member: str, planet: str) -> None:
        """A ring has a planet inside."""
        self.bodies.internal(
            self.link(member), self.teeth(member), *self.planet(planet), self.link("carrier")
        )

    def planets(self, first: str, second: str) -> None:
        """Two planets mesh with each other."""
        self.bodies.external(*self.planet(first), *self.planet(second), self.link("carrier"))


def _planetary(one: _Element) -> None:
    one.sun("sun", "planet")
    one.ring("ring", "planet")


def _double_planet(one: _Element) -> None:
    one.sun("sun", "inner")
    one.planets("inner", "outer")
    one.ring("ring", "outer")


def _stepped(one: _Element) -> None:
    """The second rim turns with the first: one body, known as `planet`."""
    body, carrier = f"{one.name}.planet", one.link("carrier")
    for wheel, rim in (("sun", "planet"), ("sun2", "planet2")):
        if wheel in one:
            one.bodies.external(one.link(wheel), one.teeth(wheel), body, one.teeth(rim), carrier)
    for wheel, rim in (("ring", "planet"), ("ring2", "planet2")):
        if wheel in one:
            one.bodies.internal(one.link(wheel), one.teeth(wheel), body, one.teeth(rim), carrier)


def _ravigneaux(one: _Element) -> None:
    if "small_sun" in one:
        one.sun("small_sun", "short")
        one.planets("short", "long")
    if "large_sun" in one:
        one.sun("large_sun", "long")
    if "ring" in one:
        one.ring("ring", "long")


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


def _gear_pair(one: _Element) -> None:
    one.bodies.external(
        one.link("first"), one.teeth("first"), one.link("second"), one.teeth("second")
    )


def _same_sense(one: _Element) -> None:
    """An internal pair, a chain or a belt: both rims run the same way."""
    one.bodies.internal(
        one.link("first"), one.teeth("first"), one.link("second"), one.teeth("second")
    )


def _idler(one: _Element) -> None:
    idler = one.planet("idler")
    one.bodies.external(one.link("first"), one.teeth("first"), *idler)
    one.bodies.external(*idler, one.link("second"), one.teeth("second"))


def _shaft(one: _Element) -> None:
    one.bodies.join(one.link("first"), one.link("second"))


def _worm(one: _Element) -> None:
    """In one turn of the worm the wheel goes on by as many teeth as the worm has threads."""
    one.bodies.tie((one.link("worm"), one.teeth("worm")), (one.link("wheel"), -one.teeth("wheel")))


def _held(one: _Element) -> None:
    one.bodies.join(one.link("link"))


KINDS: Mapping[str, Callable[[_Element], None]] = {
    "planetary": _planetary,
    "double_planet": _double_planet,
    "stepped": _stepped,
    "ravigneaux": _ravigneaux,
    "planet_group": _planet_group,
    "bevel": _bevel,
    "gear_pair": _gear_pair,
    "internal_pair": _same_sense,
    "idler": _idler,
    "chain": _same_sense,
    "belt": _same_sense,
    "shaft": _shaft,
    "worm": _worm,
    "held": _held,
}


def bodies_of(document: Document) -> Bodies:
    """All bodies of a case, with their meshes; no shift element is engaged."""
    bodies = Bodies()
    for name in document.get("links", ()):
        bodies.names.setdefault(link(name))
    for name, content in document.get("elements", {}).items():
        KINDS[content["kind"]](_Element(bodies, str(name), content))
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
