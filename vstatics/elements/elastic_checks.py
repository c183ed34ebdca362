"""What the stiffness of an element and the masses of its planets must fulfil."""

from __future__ import annotations

from collections.abc import Iterator

from vstatics.elements.element import DrawingFields, Element, PlanetMass
from vstatics.elements.group import group_of
from vstatics.elements.kinds import GROUP, Planetary
from vstatics.elements.lower import part_of
from vstatics.errors import Path, Problem, nearest, quoted, spoken
from vstatics.model.torsional_checks import not_negative, of_elastic


def of_torsion(element: Element, path: Path) -> Iterator[Problem]:
    """Numbers of an element, and what there must be beside them."""
    yield from of_elastic(element.stiffness, element.damping, path)
    if not element.planet_masses:
        return
    place = (*path, "planet")
    if element.planets is None:
        yield Problem("`planets` is missing: how many of them stand around the axis", place)
    if element.stiffness is not None:
        message = (
            "an elastic element can't have masses of planets: list the planet as a link with its "
            "inertia, and each mesh as a mechanism"
        )
        yield Problem(message, place)
    named = element.kind == GROUP or len(element.planet_names) > 1
    for name, mass in element.planet_masses.items():
        here = (*place, name) if named else place
        if name in element.planet_names:
            yield from _of_mass(mass, here)
        else:
            known = spoken(map(quoted, element.planet_names), "or")
            expected = f"expected {known}" if known else f"a {element.kind} has none"
            hint = nearest(name, element.planet_names)
            yield Problem(f"there is no planet `{name}`, {expected}{hint}", here)


def _of_mass(mass: PlanetMass, path: Path) -> Iterator[Problem]:
    yield from not_negative(mass.inertia, "an inertia", (*path, "inertia"))
    yield from not_negative(mass.mass, "a mass", (*path, "mass"))
    yield from not_negative(mass.radius, "a radius", (*path, "radius"))
    if mass.mass and not mass.radius:
        message = "`radius` is missing: how far the pin is from the axis of the set, as there is"
        yield Problem(f"{message} a mass", path)


def whole(element: Element, drawing: DrawingFields, path: Path) -> Iterator[Problem]:
    """What only an element tells that is right in itself: its rows, and the speeds of its planets.

    Parameters
    ----------
    drawing : DrawingFields
        That it is part of.
    """
    if element.stiffness is not None:
        rows = len(part_of(element, drawing, drawing.links).lowered)
        if rows > 1:
            message = (
                f"the element has {rows} rows (mechanisms), expected a stiffness of what has one: "
                "leave it out, and put springs beside the element"
            )
            yield Problem(message, (*path, "stiffness"))
    known = _known_planets(element)
    for name, mass in element.planet_masses.items():
        if mass.inertia and name not in known:
            message = f"the speed of planet {name} is not known, expected its teeth"
            yield Problem(message, (*path, "planet"))


def _known_planets(element: Element) -> set[str]:
    """Planets that have a speed by their teeth."""
    if isinstance(element.shape, Planetary):
        group = group_of(element)
        return {planet for planet in group.planets if group.is_known(planet)}
    return {name for name in element.planet_names if name in element.teeth}
