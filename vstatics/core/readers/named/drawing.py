"""Reader of cases with gear sets under `elements:`, which are converted to mechanisms."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence

from vstatics.core.annexes import KEYS
from vstatics.core.elements import teeth
from vstatics.core.elements.checks import hints, problems
from vstatics.core.elements.drawing import Drawing
from vstatics.core.elements.keys import DRAWN, element_of, with_elements
from vstatics.core.errors import Path, Problem
from vstatics.core.model.carried import installed_keys
from vstatics.core.model.shape import ByKey
from vstatics.core.readers.named import nodes
from vstatics.core.readers.named.arguments import arguments, read_with_stand_ins
from vstatics.core.readers.named.joined_links import gathered_links, is_listed, loose_links
from vstatics.core.readers.named.nodes import Spot, Spots, is_null
from vstatics.core.readers.named.walk import Walk
from vstatics.core.readers.reading import Reading, finish

_DRAWN = {"links", "link_names", "mechanisms", *(key.name for key in DRAWN)}


def read_drawing(root: nodes.Mapping, walk: Walk, case: ByKey) -> Reading:
    """Read a case with gear sets, and convert valid gear sets to mechanisms.

    Raises
    ------
    ReadError
        The error contains every problem that does not follow from another.
    """
    spots = walk.spots
    given = {key.text for key, value in root.entries if not is_null(value)}
    listed = is_listed(root)
    gathered = [] if listed else gathered_links(root, walk)
    values = walk.read(Spot((), "", root), with_elements(case, required=True))
    ends = {
        end: which
        for end, which in (("input", "first"), ("output", "last"))
        if not listed and given.isdisjoint({end, f"{end}s", "links"})
    }
    if not listed:
        values = {**values, "links": len(gathered)}
        spots.unreadable += [] if gathered else [("input",), ("output",)]
        for end, which in ends.items():
            instead = f", expected it or `links`, whose {which} link is the {end}"
            spots.missing(Spot((), "", root), end, instead)
    parts = arguments(values, walk)
    all_problems = [*spots.document.problems, *spots.document.warnings]
    locate: Callable[[Problem], Problem] = spots.locate
    if any(path and path[0] in _DRAWN for path in spots.unreadable):
        spots.unreadable += _dependent(given)
    else:
        names = parts["link_names"] or list(map(str, range(1, values["links"] + 1)))
        drawing = Drawing(
            len(names),
            tuple(element_of(name, record, names) for name, record in values["elements"].items()),
            tuple(parts["mechanisms"]),
            values.get("losses"),
            values.get("mesh_efficiency", {}),
        )
        faults = list(problems(drawing)) or list(_planets_called_like_links(drawing, names))
        if faults:
            spots.unreadable += _dependent(given)
        else:
            parts |= drawing.lowered(names)
            parts.setdefault("output", 0 if parts.get("outputs") else drawing.links)
            locate = _locator(spots, drawing)
            faults = [*hints(drawing), *teeth.doubts(drawing)]
            if not (listed or ends):
                faults += loose_links(root, values, names, parts["gears"], spots)
        all_problems += map(spots.locate, faults)
    return finish(parts, all_problems, read_with_stand_ins(spots.unreadable), locate)


def _dependent(given: Collection[str]) -> list[Path]:
    """Return the paths where problems only follow from errors in gear sets."""
    keys = installed_keys(name for name in KEYS if name in given)
    naming = [key.shape.name for key in keys if key.names_members]
    return [(name,) for name in ("links", "mechanisms", *naming)]


def _planets_called_like_links(drawing: Drawing, names: Sequence[str]) -> Iterator[Problem]:
    for number, part in enumerate(drawing.parts, 1):
        for planet in part.planet_links:
            if f"{part.name}.{planet}" in names:
                message = f"planet {planet} has the name `{part.name}.{planet}`, like a link"
                yield Problem("E106", f"{message}; expected another name", ("elements", number))


def _locator(spots: Spots, drawing: Drawing) -> Callable[[Problem], Problem]:
    """Return a function that gives a problem of a mechanism the place of its gear set."""
    paths = []
    for number, part in enumerate(drawing.parts, 1):
        count = number - len(drawing.elements)
        path: Path = ("elements", number) if part.element else ("mechanisms", count)
        paths += [path] * len(part.lowered)

    def locate(problem: Problem) -> Problem:
        if problem.path[:1] == ("mechanisms",) and len(problem.path) > 1:
            return spots.locate(
                problem._replace(path=(*paths[int(problem.path[1]) - 1], *problem.path[2:]))
            )
        return spots.locate(problem)

    return locate
