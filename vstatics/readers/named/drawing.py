"""Cases that are drawn: names of links gathered from their elements, and the elements made."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any

from vstatics.elements import teeth
from vstatics.elements.build import lowered
from vstatics.elements.checks import hints, problems
from vstatics.elements.element import Drawing
from vstatics.elements.keys import DRAWN, drawn, element_of, with_elements
from vstatics.elements.kinds import KINDS
from vstatics.elements.lower import parts as parts_of
from vstatics.errors import Path, Problem
from vstatics.model.keys import CASE
from vstatics.model.parts import Gear, Mechanism
from vstatics.readers.named import nodes
from vstatics.readers.named.arguments import arguments, untold
from vstatics.readers.named.nodes import Listing, Node, Scalar, Spot, Spots, is_null, shown
from vstatics.readers.named.walk import Walk
from vstatics.readers.reading import Reading, finish

_MECHANISM = ("first", "second", "third")
_DRAWN = {"links", "link_names", "mechanisms", *(key.name for key in DRAWN)}


def joined_links(root: nodes.Mapping) -> Iterator[Scalar]:
    """Every place of a document where an element, a mechanism or a shift element names a link.

    In the order of the document, the housing apart.
    """
    for key, value in root.entries:
        if not isinstance(value, nodes.Mapping):
            continue
        for _, item in value.entries:
            if key.text == "elements":
                yield from _scalars(_of_element(item))
            elif key.text == "mechanisms":
                yield from _scalars(_values(item, _MECHANISM))
            elif key.text == "shift_elements":
                yield from _scalars(_of_shift_element(item))


def _scalars(found: Iterable[Node]) -> Iterator[Scalar]:
    for node in found:
        if isinstance(node, Scalar) and not is_null(node) and node.text not in ("0", "housing"):
            yield node


def _values(node: Node, keys: Iterable[str]) -> Iterator[Node]:
    """What stands under some keys of a mapping."""
    if isinstance(node, nodes.Mapping):
        wanted = set(keys)
        yield from (value for key, value in node.entries if key.text in wanted)


def _of_element(node: Node) -> Iterator[Node]:
    kind = next(iter(_values(node, ["kind"])), None)
    if isinstance(kind, Scalar) and kind.text in KINDS:
        yield from _values(node, KINDS[kind.text].members)
    for wheels in _values(node, ("suns", "rings")):
        for wheel in wheels.items if isinstance(wheels, Listing) else ():
            yield from _values(wheel, ["link"])


def _of_shift_element(node: Node) -> Iterator[Node]:
    for ends in [node, *_values(node, ["links"])]:
        yield from ends.items if isinstance(ends, Listing) else ()


def read_drawing(root: nodes.Mapping, walk: Walk) -> Reading:
    """A case made of elements; they become mechanisms if nothing is wrong with them.

    Raises
    ------
    ReadError
        With every problem that can be told from the others.
    """
    spots = walk.spots
    given = {key.text for key, value in root.entries if not is_null(value)}
    listed = "links" in given
    if not listed:
        walk.references.set_link_names(list(dict.fromkeys(n.text for n in joined_links(root))))
    values = walk.read(Spot((), "", root), drawn(with_elements(CASE)))
    if not listed:
        values = {**values, "links": len(walk.references.link_names)}
        for end in ("input", "output"):
            if end not in given:
                spots.missing(Spot((), "", root), end)
    parts = arguments(values, walk)
    found = list(spots.found.problems)
    locate: Callable[[Problem], Problem] = spots.locate
    if any(path and path[0] in _DRAWN for path in spots.unreadable):
        spots.unreadable += [("links",), ("mechanisms",)]
    else:
        names = parts["link_names"] or list(map(str, range(1, values["links"] + 1)))
        made = drawing(values, names, parts["mechanisms"])
        faults = list(problems(made)) or list(_planets_called_like_links(made, names))
        if faults:
            spots.unreadable += [("links",), ("mechanisms",)]
        else:
            parts |= lowered(made, names)
            parts["output"] = parts.get("output", made.links)
            locate = _locator(spots, made)
            faults = [*hints(made), *teeth.doubts(made)]
            faults += [] if listed else loose_links(root, values, names, parts["gears"], spots)
        found += map(spots.locate, faults)
    return finish(parts, found, untold(spots.unreadable), locate)


def _planets_called_like_links(made: Drawing, names: Sequence[str]) -> Iterator[Problem]:
    for number, part in enumerate(parts_of(made), 1):
        for planet in part.planet_links:
            if f"{part.name}.{planet}" in names:
                message = f"planet {planet} is called `{part.name}.{planet}`, as a link is"
                yield Problem(f"{message}; expected another name", ("elements", number))


def _locator(spots: Spots, drawn: Drawing) -> Callable[[Problem], Problem]:
    """Gives a problem with a mechanism the place of the element that it was made from."""
    paths: list[Path] = []
    for number, part in enumerate(parts_of(drawn), 1):
        count = number - len(drawn.elements)
        path: Path = ("elements", number) if part.element else ("mechanisms", count)
        paths += [path] * len(part.lowered)

    def locate(problem: Problem) -> Problem:
        if problem.path[:1] == ("mechanisms",) and len(problem.path) > 1:
            return spots.locate(
                problem._replace(path=(*paths[int(problem.path[1]) - 1], *problem.path[2:]))
            )
        return spots.locate(problem)

    return locate


def loose_links(
    root: nodes.Mapping,
    values: Mapping[str, Any],
    names: Sequence[str],
    gears: Sequence[Gear],
    spots: Spots,
) -> Iterator[Problem]:
    """Links that one thing only joins, where the document has no list of links.

    A carrier may turn freely, so it is told only if its name looks mistyped.
    """
    found = list(joined_links(root))
    counts = Counter(node.text for node in found)
    carriers = {record.get("carrier") for record in values["elements"].values()}
    told = {values.get("input"), values.get("output")}
    for gear in gears:
        told.update((*gear.speeds, *gear.torques, *gear.drag, gear.input, gear.output))
    for number, name in enumerate(names, 1):
        others = [*(other for other in names if other != name), "housing"]
        hint = spots.found.hint(name, others)
        if counts[name] == 1 and number not in told and (hint or number not in carriers):
            node = next(node for node in found if node.text == name)
            message = f"link `{shown(name)}` is joined to nothing else{hint}"
            place = spots.found.source.place(node.line, node.column)
            yield Problem(message, (), place, "warning")


def drawing(
    values: Mapping[str, Any], link_names: Sequence[str], mechanisms: Iterable[Mechanism]
) -> Drawing:
    """The drawing that the values of a case tell of.

    Parameters
    ----------
    values : mapping
        Of the keys `elements`, `losses` and `mesh_efficiency`.
    link_names : sequence of str
        Of the case's own links.
    mechanisms : iterable of Mechanism
        That stand beside the elements.
    """
    return Drawing(
        len(link_names),
        tuple(element_of(name, one, link_names) for name, one in values["elements"].items()),
        tuple(mechanisms),
        values.get("losses"),
        values.get("mesh_efficiency", {}),
    )
