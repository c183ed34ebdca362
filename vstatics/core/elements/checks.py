"""Checks of gear sets before their conversion to mechanisms.

The reader has already checked keys and types of values. This module checks whether mechanisms can
be calculated, including stiffnesses and planet masses. Doubtful geometry of teeth, which does not
prevent a calculation, is reported by the package `teeth`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import product

from vstatics.core.elements import group_checks
from vstatics.core.elements.element import DrawingFields, Element
from vstatics.core.elements.group import PlanetGroup, group_of
from vstatics.core.elements.group_checks import LARGEST_WHEEL
from vstatics.core.elements.kinds import GROUP, KINDS, Kind, Planetary, Simple
from vstatics.core.elements.lower import at_meshes, part_of
from vstatics.core.elements.mesh_losses import LEAST_RING, mesh_losses
from vstatics.core.errors import Path, Problem, plural, quoted, spoken
from vstatics.core.model.part_checks import of_back_efficiency, of_efficiency, sets_side_by_side
from vstatics.core.model.torsional_checks import not_negative, of_elastic
from vstatics.core.suggestions import nearest


def problems(drawing: DrawingFields) -> Iterator[Problem]:
    """Yield the errors of all gear sets, in the order of the case."""
    yield from _mesh_efficiency(drawing.mesh_efficiency, ())
    yield from _friction(drawing)
    for number, element in enumerate(drawing.elements, 1):
        path = ("elements", number)
        errors = [*_problems(element, path)]
        yield from errors
        if not errors and isinstance(element.shape, Planetary):
            errors = [*group_checks.whole(element, path)]
            yield from errors
        if not errors and _is_torsional(element):
            yield from whole(element, drawing, path)


def hints(drawing: DrawingFields) -> Iterator[Problem]:
    """Yield warnings and notes on unused or equal gears, shared planets and missing values."""
    for number, element in enumerate(drawing.elements, 1):
        if element.kind in ("belt", "chain") and element.efficiency is None:
            message = (
                "`efficiency` is missing: belts and chains have no default, so no "
                "loss is calculated"
            )
            yield Problem("N304", message, ("elements", number))
        if isinstance(element.shape, Planetary):
            for wheel in element.shape.wheels:
                if wheel in element.teeth and wheel not in element.members:
                    message = f"the gear is ignored, because its link is missing (`{wheel}: ...`)"
                    yield Problem("W301", message, ("elements", number, "teeth", wheel))
            group = group_of(element)
            yield from _alike(group, ("elements", number))
            unknown = [planet for planet in group.planets if not group.is_known(planet)]
            if unknown:
                planets = f"{plural('planet', len(unknown))} {spoken(unknown)}"
                lacking = "its speed is" if len(unknown) == 1 else "their speeds are"
                message = f"`teeth` has no number for {planets}, so {lacking} unknown"
                yield Problem("N305", message, ("elements", number))
            if group.is_shared and not at_meshes(element, group, drawing):
                yield Problem(
                    "N301",
                    "several gears share planets, so the losses of the simplified form are not "
                    "exact; `losses: meshes` calculates the losses at each mesh",
                    ("elements", number),
                )
    yield from _side_by_side(drawing)


def _alike(group: PlanetGroup, path: Path) -> Iterator[Problem]:
    """Report pairs of central gears with a ratio of 1, which rotate at equal speeds."""
    for train in group.trains:
        seen: dict[Fraction, str] = {}
        for wheel in group.wheels_of(train):
            first = seen.setdefault(group.relative(wheel, train), wheel.member)
            if first != wheel.member:
                yield Problem(
                    "N302",
                    f"{first} and {wheel.member} always turn at the same speed (ratio 1): "
                    "the carrier receives torque from them only through losses",
                    path,
                )


def _side_by_side(drawing: DrawingFields) -> Iterator[Problem]:
    """Report gear sets that share a central gear and the carrier, as in a Ravigneaux set."""
    sets = (
        (
            number,
            element.name,
            element.link("carrier"),
            [wheel.link for wheel in group_of(element).wheels],
        )
        for number, element in enumerate(drawing.elements, 1)
        if isinstance(element.shape, Planetary)
    )
    for number, other in sets_side_by_side(sets):
        yield Problem(
            "N303",
            f"shares a central gear and the carrier with {other}: if they also share planets, "
            "describe them as one gear set, such as `ravigneaux` or `planet_group`; "
            "otherwise the losses are not exact",
            ("elements", number),
        )


def _problems(element: Element, path: Path) -> Iterator[Problem]:
    if element.kind not in KINDS:
        known = f"expected one of {', '.join(KINDS)}{nearest(element.kind, KINDS)}"
        yield Problem("E224", f"read {element.kind!r}, {known}", (*path, "kind"))
        return
    kind = element.shape
    yield from _apart(element, kind, path)
    if element.kind == GROUP:
        yield from group_checks.rims(element, path)
    elif isinstance(kind, Planetary):
        yield from _planetary(element, kind, path)
    else:
        yield from _simple(element, kind, path)
    if element.efficiency is not None:
        place = (*path, "efficiency")
        worm = element.kind == "worm"
        yield from of_efficiency(element.efficiency, (*place, "worm") if worm else place)
        back = (*place, "wheel") if worm else (*path, "back_efficiency")
        yield from of_back_efficiency(element.back_efficiency, back)
    elif element.back_efficiency is not None:
        message = (
            "it needs `efficiency`, which applies to power from the first member to the second"
        )
        yield Problem("E302", message, (*path, "back_efficiency"))
    yield from _mesh_efficiency(element.mesh_efficiency, path)
    if element.efficiency is not None and element.mesh_efficiency:
        message = "`efficiency` is the efficiency of the whole gear set; give one of the two"
        yield Problem("E302", message, (*path, "mesh_efficiency"))
    if element.planets is not None and element.planets < 1:
        message = f"read {element.planets}, expected the number of planets, 1 or more"
        yield Problem("E303", message, (*path, "planets"))
    if _is_torsional(element):
        yield from of_torsion(element, path)


def _friction(drawing: DrawingFields) -> Iterator[Problem]:
    """Report rings with too few teeth to calculate the efficiency from friction."""
    for number, element in enumerate(drawing.elements, 1):
        losses = mesh_losses(drawing.mesh_efficiency, element.mesh_efficiency)
        if losses.friction is None or "internal" in losses.given or element.efficiency is not None:
            continue
        rings = [name for name in element.teeth if name.startswith("ring")]
        rings += ["second"] * (element.kind == "internal_pair")
        for ring in rings:
            if (teeth := element.teeth.get(ring, LEAST_RING)) < LEAST_RING:
                yield Problem(
                    "E334",
                    f"read {teeth} teeth, expected {LEAST_RING} at least: the tips of a standard "
                    "ring with fewer are inside its base circle, so friction gives no efficiency",
                    ("elements", number, "teeth", ring),
                )


def _is_torsional(element: Element) -> bool:
    return bool(element.stiffness is not None or element.damping or element.planet_masses)


def _mesh_efficiency(efficiencies: Mapping[str, float], path: Path) -> Iterator[Problem]:
    for mesh, value in efficiencies.items():
        if mesh == "friction":
            if not 0 < value < 1:
                message = f"read {value:g}, expected a coefficient of friction between 0 and 1"
                yield Problem("E333", message, (*path, "mesh_efficiency", mesh))
            continue
        yield from of_efficiency(value, (*path, "mesh_efficiency", mesh))


def _planetary(element: Element, kind: Planetary, path: Path) -> Iterator[Problem]:
    missing = [*_missing(element, kind, path)]
    yield from missing
    wheels = [member for member in kind.wheels if member in element.members]
    if not missing and len(wheels) < 2:
        names = ", ".join(kind.wheels)
        number = f"{len(wheels)} central {plural('gear', len(wheels))}"
        yield Problem("E304", f"read {number}, expected two or more of {names}", path)
    used = {kind.wheels[wheel].rim for wheel in wheels}
    several = {
        rim for rims in kind.planets.values() if len(used.intersection(rims)) > 1 for rim in rims
    }
    needed = [*wheels, *(rim for rim in kind.toothed if rim in used & several)]
    if element.ratios:
        yield from _ratios(element, path)
        return
    yield from _teeth(element, needed, kind.toothed, path)
    for ring, sun in product(wheels, wheels):
        around, within = kind.wheels[ring], kind.wheels[sun]
        inner, outer = element.teeth.get(sun, 0), element.teeth.get(ring, math.inf)
        is_around = around.rim == within.rim and around.internal and not within.internal
        if is_around and outer <= inner:
            message = f"read {outer:g}, expected more teeth than the {inner:g} of {sun}"
            yield Problem("E305", message, (*path, "teeth", ring))


def _ratios(element: Element, path: Path) -> Iterator[Problem]:
    place = (*path, "ratios")
    excluded = [key for key in ("teeth", "planet_masses", "stiffness") if getattr(element, key)]
    if (
        excluded
        or element.efficiency is None
        or not {"small_sun", "large_sun", "ring"} <= {*element.members}
    ):
        message = "`ratios` replaces `teeth`, planet masses and stiffness"
        expected = (
            "expected `small_sun`, `large_sun`, `ring` and `efficiency`, which "
            "applies to each ratio"
        )
        yield Problem("E797", f"{message}; {expected}", place)
    small, large = (element.ratios.get(sun, math.nan) for sun in ("small_sun", "large_sun"))
    if not (1 < small < LARGEST_WHEEL and 1 < -large < LARGEST_WHEEL):
        read = f"read {small:g} of the small sun and {large:g} of the large one"
        yield Problem(
            "E797",
            f"{read}, expected a number above 1 for the small sun and a number below -1 for "
            "the large sun",
            place,
        )


def _missing(element: Element, kind: Kind, path: Path) -> Iterator[Problem]:
    for member in kind.members:
        if member not in element.members and member not in kind.optional:
            yield Problem("E306", f"`{member}` is missing: expected the link of this member", path)


def _apart(element: Element, kind: Kind, path: Path) -> Iterator[Problem]:
    """Report different members on the same link, which would lock up or stop the gear set."""
    if element.kind == GROUP:
        return  # two gears on the same link can mesh with planets of different trains
    seen: dict[int, str] = {}
    for member in kind.members:
        link = element.members.get(member)
        if link is None:
            continue
        if link in seen:
            message = f"{seen[link]} and {member} are the same link, expected different ones"
            yield Problem("E307", message, (*path, member))
        seen.setdefault(link, member)


def _simple(element: Element, kind: Simple, path: Path) -> Iterator[Problem]:
    yield from _missing(element, kind, path)
    if element.kind == "shaft" and element.efficiency is None:
        yield Problem("E308", "`efficiency` is missing: a shaft is listed only for its loss", path)
    needed = [kind.toothed[0], kind.toothed[-1]] if kind.toothed else []
    if not (kind.optional_teeth and not element.teeth):
        yield from _teeth(element, needed, kind.toothed, path, kind.size)
    first, second = (element.teeth.get(wheel) for wheel in ("first", "second"))
    if element.kind == "internal_pair" and first and first == second:
        message = (
            "the ring gear has as many teeth as the gear inside it, expected a "
            "ring gear with more teeth"
        )
        yield Problem("E309", message, (*path, "teeth"))


def _teeth(
    element: Element, needed: Sequence[str], known: Sequence[str], path: Path, size: str = "teeth"
) -> Iterator[Problem]:
    missing = [name for name in needed if name not in element.teeth]
    if missing:
        names = " and ".join(f"`{name}`" for name in missing)
        yield Problem(
            "E310", f"{size} of {names} missing", (*path, size) if element.teeth else path
        )
    for name, count in element.teeth.items():
        if name not in known:
            message = f"unknown: expected {', '.join(known)}{nearest(name, known)}"
            yield Problem("E311", message, (*path, size, name))
        elif not 1 / LARGEST_WHEEL < count < LARGEST_WHEEL:
            message = f"read {count:g}, expected a number above 0 and below {LARGEST_WHEEL:g}"
            yield Problem("E312", message, (*path, size, name))


def of_torsion(element: Element, path: Path) -> Iterator[Problem]:
    """Report errors in the stiffness, damping and planet masses of a gear set."""
    yield from of_elastic(element.stiffness, element.damping, path)
    if not element.planet_masses:
        return
    place = (*path, "planet")
    if element.planets is None:
        yield Problem(
            "E313", "`planets` is missing: expected the number of planets around the axis", place
        )
    if element.stiffness is not None:
        yield Problem(
            "E314",
            "a gear set with a stiffness cannot have planet masses: list the planet as a link "
            "with its inertia, and each mesh as a mechanism",
            place,
        )
    named = element.kind == GROUP or len(element.planet_names) > 1
    for name, mass in element.planet_masses.items():
        here = (*place, name) if named else place
        if name in element.planet_names:
            yield from not_negative(mass.inertia, "an inertia", (*here, "inertia"))
            yield from not_negative(mass.mass, "a mass", (*here, "mass"))
            yield from not_negative(mass.radius, "a radius", (*here, "radius"))
            if mass.mass and not mass.radius:
                message = (
                    "`radius` is missing: expected the distance of the planet "
                    "from the main axis, because the planet has"
                )
                yield Problem("E316", f"{message} a mass", here)
        else:
            known = spoken(map(quoted, element.planet_names), "or")
            expected = f"expected {known}" if known else f"a {element.kind} has none"
            hint = nearest(name, element.planet_names)
            yield Problem("E315", f"there is no planet `{name}`, {expected}{hint}", here)


def whole(element: Element, drawing: DrawingFields, path: Path) -> Iterator[Problem]:
    """Report a stiffness for several mechanisms, and planet inertias without a known speed.

    Parameters
    ----------
    drawing : DrawingFields
        Drawing that contains the gear set.
    """
    if element.stiffness is not None:
        rows = len(part_of(element, drawing, drawing.links).lowered)
        if rows > 1:
            yield Problem(
                "E317",
                f"the gear set has {rows} mechanisms, but a stiffness needs a single mechanism: "
                "remove it, and add springs to the links of the gear set",
                (*path, "stiffness"),
            )
    known = _known_planets(element)
    for name, mass in element.planet_masses.items():
        if mass.inertia and name not in known:
            message = (
                f"the speed of planet {name} is unknown, expected the tooth numbers of the gear set"
            )
            yield Problem("E318", message, (*path, "planet"))


def _known_planets(element: Element) -> set[str]:
    if isinstance(element.shape, Planetary):
        group = group_of(element)
        return {planet for planet in group.planets if group.is_known(planet)}
    return {name for name in element.planet_names if name in element.teeth}
