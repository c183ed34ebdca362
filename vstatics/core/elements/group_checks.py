"""Checks of planet groups before their conversion to mechanisms."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from fractions import Fraction

from vstatics.core.elements.element import CentralWheel, Element
from vstatics.core.elements.group import PlanetGroup, group_of
from vstatics.core.elements.kinds import GROUP
from vstatics.core.errors import Path, Problem
from vstatics.core.model.parts import HOUSING
from vstatics.core.suggestions import nearest

LARGEST_WHEEL = 10**6
"""Number of teeth or diameter from which a gear is refused, far above any real gear.

Ratios of smaller numbers are still exact.
"""

MOST_PLANET_KINDS = 20
"""Largest number of different planets on a carrier. Real groups have two or three."""


def rims(element: Element, path: Path) -> Iterator[Problem]:
    """Report errors in the rims (gears) of planets, in central gears and in meshes of a group."""
    seen = {}
    for planet, rims_of_planet in element.rims.items():
        place = (*path, "rims", planet)
        if not rims_of_planet:
            yield Problem("E319", "the planet has no gear, expected its name and teeth", place)
        for rim, count in rims_of_planet.items():
            yield from _count(count, (*place, rim))
            if rim in seen:
                yield Problem(
                    "E320",
                    f"the name `{rim}` appears twice, expected a different name for "
                    "each planet gear",
                    place,
                )
            seen[rim] = planet
    if len(element.wheels) < 2:
        yield Problem(
            "E321", f"{len(element.wheels)} sun and ring gears, expected two or more", path
        )
    yield from _wheels(element, seen, path)


def _wheels(element: Element, rims: Collection[str], path: Path) -> Iterator[Problem]:
    """Report wrong sizes or names of central gears, and unknown rims that gears or meshes name."""
    named: list[tuple[Path, str]]
    named = [((*wheel_path(element, wheel), "rim"), wheel.rim) for wheel in element.wheels]
    for number, pair in enumerate(element.meshes, 1):
        named += [(("meshes", number, side), pair[side - 1]) for side in (1, 2)]
    for wheel in element.wheels:
        yield from _count(wheel.teeth, (*path, *wheel_path(element, wheel), "teeth"))
        if wheel.member in {"carrier", *element.rims}:
            yield Problem(
                "E322",
                f"gear `{wheel.member}` has the name of another member, expected another name",
                path,
            )
    for place, rim in named:
        if rim not in rims:
            known = nearest(rim, rims) or f": {', '.join(rims) or 'none is listed'}"
            yield Problem(
                "E323", f"read `{rim}`, expected the name of a planet gear{known}", (*path, *place)
            )


def _count(teeth: int, path: Path) -> Iterator[Problem]:
    if teeth >= LARGEST_WHEEL:
        yield Problem("E324", f"read {teeth}, expected fewer than {LARGEST_WHEEL} teeth", path)


def wheel_path(element: Element, wheel: CentralWheel) -> Path:
    """Return the path of a central gear in a gear set, such as the second item of `suns`."""
    alike = [other for other in element.wheels if other.internal == wheel.internal]
    return ("rings" if wheel.internal else "suns", alike.index(wheel) + 1)


def whole(element: Element, path: Path) -> Iterator[Problem]:
    """Report errors that concern the planet group as a whole: speeds, meshes and efficiency."""
    group = group_of(element)
    if len(group.planets) > MOST_PLANET_KINDS:
        message = f"read {len(group.planets)} planets, expected at most {MOST_PLANET_KINDS}"
        yield Problem("E325", message, (*path, "rims"))
        return
    for rim, other in group.meshes:
        if group.planet_of[rim] == group.planet_of[other]:
            yield Problem(
                "E326",
                f"gears `{rim}` and `{other}` are on the same planet, expected gears of "
                "two planets",
                (*path, "meshes"),
            )
            return
    try:
        trains = group.trains
    except ValueError as error:
        yield Problem(
            "E327", f"{error}: their tooth numbers contradict each other", (*path, "meshes")
        )
        return
    counts = [len(group.wheels_of(train)) for train in trains]
    for train, count in zip(trains, counts, strict=True):
        if count < 2:
            names = " and ".join(train)
            message = f"{count} central gear meshes with planet {names}, expected two or more"
            yield Problem("E328", f"{message}; is a mesh between planets missing?", path)
    is_single = bool(element.ratios)  # all `ratios` of suns have the same efficiency
    if element.efficiency is not None and not is_single and (max(counts) > 2 or len(counts) > 1):
        message = "read one efficiency for several power paths; give `mesh_efficiency` instead"
        yield Problem("E329", message, (*path, "efficiency"))
    if element.kind == GROUP:
        yield from _group_wheels(element, group, path)


def _group_wheels(element: Element, group: PlanetGroup, path: Path) -> Iterator[Problem]:
    """Report central gears that are on the carrier's link, too small, or block the planets."""
    for wheel in group.wheels:
        place = (*path, *wheel_path(element, wheel))
        if wheel.link == group.carrier != HOUSING:
            yield Problem(
                "E330",
                "the gear is on the link of the carrier, expected another link",
                (*place, "link"),
            )
        for other in group.wheels:
            around = wheel.internal and not other.internal and wheel.rim == other.rim
            if around and wheel.teeth <= other.teeth:
                message = f"read {wheel.teeth}, expected more teeth than the {other.teeth} of"
                yield Problem("E305", f"{message} {other.member}", (*place, "teeth"))
    for train in group.trains:
        speeds: dict[int, Fraction] = {}
        for wheel in group.wheels_of(train):
            speed = group.relative(wheel, train)
            if speeds.setdefault(wheel.link, speed) != speed:
                message = (
                    "another gear on this link would turn at another speed on the "
                    "same planets, which would block them; name another link"
                )
                yield Problem("E332", message, (*path, *wheel_path(element, wheel), "link"))
