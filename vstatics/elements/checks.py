"""What elements must fulfil before they become mechanisms; problems with paths.

The reader has seen to keys and kinds of values. Conditions on the geometry of teeth,
which leave a case calculable, are in `teeth`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from vstatics.elements.element import CentralWheel, Drawing, Element
from vstatics.elements.group import group_of
from vstatics.elements.kinds import GROUP, KINDS, Planetary, Simple
from vstatics.elements.lower import at_meshes
from vstatics.errors import Path, Problem, nearest
from vstatics.model import HOUSING


def problems(drawing: Drawing) -> Iterator[Problem]:
    """Every error of the elements, in their order."""
    yield from _mesh_efficiency(drawing.mesh_efficiency, ())
    for number, element in enumerate(drawing.elements, 1):
        path = ("elements", number)
        found = [*_problems(element, path)]
        yield from found
        if not found and isinstance(element.shape, Planetary):
            yield from _group(element, path)


def hints(drawing: Drawing) -> Iterator[Problem]:
    """Notes on elements that share planets and are calculated in the reduced form all the same."""
    for number, element in enumerate(drawing.elements, 1):
        if isinstance(element.shape, Planetary):
            group = group_of(element)
            if group.is_shared and not at_meshes(element, group, drawing):
                message = (
                    "several wheels share planets, and the losses of the reduced form are not "
                    "exact then; `losses: meshes` calculates them at each mesh"
                )
                yield Problem(message, ("elements", number), severity="note")


def _problems(element: Element, path: Path) -> Iterator[Problem]:
    if element.kind not in KINDS:
        known = f"expected one of {', '.join(KINDS)}{nearest(element.kind, KINDS)}"
        yield Problem(f"read {element.kind!r}, {known}", (*path, "kind"))
        return
    kind = element.shape
    if element.kind == GROUP:
        yield from _rims(element, path)
    elif isinstance(kind, Planetary):
        yield from _planetary(element, kind, path)
    else:
        yield from _simple(element, kind, path)
    if element.efficiency is not None:
        place = (*path, "efficiency")
        worm = element.back_efficiency is not None
        yield from _efficiency(element.efficiency, (*place, "worm") if worm else place)
    back = element.back_efficiency
    if back is not None and not 0 <= back <= 1:
        message = f"read {back:g}, expected an efficiency from 0 (self-locking) to 1"
        yield Problem(message, (*path, "efficiency", "wheel"))
    yield from _mesh_efficiency(element.mesh_efficiency, path)
    if element.planets is not None and element.planets < 1:
        message = f"read {element.planets}, expected the number of planets around the axis"
        yield Problem(message, (*path, "planets"))


def _efficiency(value: float, path: Path) -> Iterator[Problem]:
    if not 0 < value <= 1:
        yield Problem(f"read {value:g}, expected an efficiency above 0 and up to 1", path)


def _mesh_efficiency(given: Mapping[str, float], path: Path) -> Iterator[Problem]:
    for mesh, value in given.items():
        yield from _efficiency(value, (*path, "mesh_efficiency", mesh))


def _planetary(element: Element, kind: Planetary, path: Path) -> Iterator[Problem]:
    """A kind with a fixed layout: members, and the teeth that its ratios need."""
    missing = [m for m in kind.members if m not in element.members and m not in kind.optional]
    for member in missing:
        yield Problem(f"`{member}` is missing: the link that it belongs to", path)
    wheels = [member for member in kind.wheels if member in element.members]
    if not missing and len(wheels) < 2:
        names = ", ".join(kind.wheels)
        yield Problem(
            f"there are {len(wheels)} central wheels, expected two or more of {names}", path
        )
    used = {kind.wheels[wheel].rim for wheel in wheels}
    several = {
        rim for rims in kind.planets.values() if len(used.intersection(rims)) > 1 for rim in rims
    }
    needed = [*wheels, *(rim for rim in kind.toothed if rim in used & several)]
    yield from _teeth(element, needed, kind.toothed, path)
    sun, ring = (element.teeth.get(wheel) for wheel in ("sun", "ring"))
    if sun and ring and ring <= sun:
        message = f"read {ring:g}, expected more teeth than the sun's {sun:g}"
        yield Problem(message, (*path, "teeth", "ring"))


def _simple(element: Element, kind: Simple, path: Path) -> Iterator[Problem]:
    for member in kind.members:
        if member not in element.members:
            yield Problem(f"`{member}` is missing: the link that it belongs to", path)
    if element.kind == "shaft" and element.efficiency is None:
        yield Problem("`efficiency` is missing: a shaft is here for its loss", path)
    needed = [kind.toothed[0], kind.toothed[-1]] if kind.toothed else []
    if not (kind.optional_teeth and not element.teeth):
        yield from _teeth(element, needed, kind.toothed, path, kind.size)
    first, second = (element.teeth.get(wheel) for wheel in ("first", "second"))
    if element.kind == "internal_pair" and first and first == second:
        message = "the ring has as many teeth as the wheel in it, expected other numbers"
        yield Problem(message, (*path, "teeth"))


def _teeth(
    element: Element, needed: Sequence[str], known: Sequence[str], path: Path, size: str = "teeth"
) -> Iterator[Problem]:
    missing = [name for name in needed if name not in element.teeth]
    if missing:
        names = " and ".join(f"`{name}`" for name in missing)
        yield Problem(f"{size} of {names} missing", (*path, size) if element.teeth else path)
    for name, count in element.teeth.items():
        if name not in known:
            message = f"unknown: expected {', '.join(known)}{nearest(name, known)}"
            yield Problem(message, (*path, size, name))
        elif not count > 0:
            yield Problem(f"read {count:g}, expected a number above 0", (*path, size, name))


def _rims(element: Element, path: Path) -> Iterator[Problem]:
    """A group of planets: names of rims, each known and only once."""
    seen: dict[str, str] = {}
    for planet, rims in element.rims.items():
        place = (*path, "rims", planet)
        if not rims:
            yield Problem("there is no rim, expected its name and teeth", place)
        for rim in rims:
            if rim in seen:
                message = f"rim `{rim}` is there already; expected a name of its own"
                yield Problem(message, place)
            seen[rim] = planet
    if len(element.wheels) < 2:
        yield Problem(f"{len(element.wheels)} suns and rings, expected two or more", path)
    named: list[tuple[Path, str]]
    named = [((*_wheel_path(element, wheel), "rim"), wheel.rim) for wheel in element.wheels]
    for number, pair in enumerate(element.meshes, 1):
        named += [(("meshes", number, side), pair[side - 1]) for side in (1, 2)]
    for place, rim in named:
        if rim not in seen:
            known = nearest(rim, seen) or ": " + ", ".join(seen)
            message = f"read `{rim}`, expected the name of a rim{known}"
            yield Problem(message, (*path, *place))


def _wheel_path(element: Element, wheel: CentralWheel) -> Path:
    """Where a sun or a ring stands in its element: in a list for each."""
    alike = [other for other in element.wheels if other.internal == wheel.internal]
    return ("rings" if wheel.internal else "suns", alike.index(wheel) + 1)


def _group(element: Element, path: Path) -> Iterator[Problem]:
    """What only the group as a whole tells."""
    group = group_of(element)
    for one, other in group.meshes:
        if group.planet_of[one] == group.planet_of[other]:
            yield Problem(f"rims `{one}` and `{other}` are on one planet", (*path, "meshes"))
            return
    try:
        trains = group.trains
    except ValueError as error:
        yield Problem(f"{error}: their teeth don't agree", (*path, "meshes"))
        return
    counts = [len(group.wheels_of(train)) for train in trains]
    for train, count in zip(trains, counts, strict=True):
        if count < 2:
            names = " and ".join(train)
            message = f"{count} central wheel meshes with planet {names}, expected two or more"
            yield Problem(f"{message}; is a mesh between planets missing?", path)
    if element.efficiency is not None and (max(counts) > 2 or len(counts) > 1):
        message = "one efficiency for several paths of power; give `mesh_efficiency` instead"
        yield Problem(message, (*path, "efficiency"))
    carrier = group.carrier
    for wheel in group.wheels:
        if wheel.link == carrier != HOUSING:
            message = f"{wheel.member} and carrier are the same link, expected different ones"
            yield Problem(message, path)
