"""Numbers of a scenario and its case, given by a path in one of the two documents."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from contextlib import suppress
from typing import NamedTuple

from vstatics.core.errors import Place, quoted
from vstatics.core.model.paths import (
    BODIES,
    Keys,
    NoValueError,
    PathPart,
    in_document,
    split,
    with_unit,
    written,
)
from vstatics.core.model.shape import UNIT_OF
from vstatics.core.readers.named.node_numbers import (
    WrittenNumber,
    child,
    find_node,
    keys_of,
    number_of,
    number_text,
    replaced,
)
from vstatics.core.readers.named.nodes import Listing, Mapping, Node, Scalar
from vstatics.core.readers.named.si_units import in_any_unit
from vstatics.core.suggestions import nearest
from vstatics.sweep.variants.targets import refusal

_SPELLED: dict[str, dict[type[Node], str]] = {
    "controls": {Listing: "points", Scalar: "formula"},
    "torques": {Listing: "points", Scalar: "formula"},
    "shift_elements": {Listing: "links"},
    "gears": {Listing: "engaged"},
}
"""Key that a short form omits, by outer key and kind of node: `points` for `T: [[0, 1]]`.
"""
_ALL_GIVEN = ("numbers", "set")
"""Keys of mappings that list all names that formulas can use. Any other name is a mistake."""


class NumberPath(NamedTuple):
    """Path to a number in a scenario or in the case of the scenario."""

    keys: Keys
    of_case: bool
    """True for a number in the case, False for a number in the scenario."""
    unit: str = ""
    """Unit of the values, as written in brackets; empty for numbers without a unit."""

    @property
    def name(self) -> str:
        """Name as written by the user, such as `shifts.1.overlap` or `start.speed [rpm]`."""
        return f"{written(self.keys)} [{self.unit}]" if self.unit else written(self.keys)

    @property
    def numbers(self) -> frozenset[Hashable]:
        """Key that identifies the number: the document and the path within the document."""
        return frozenset([(self.of_case, self.keys)])


class Trees(NamedTuple):
    """Scenario and case as trees of nodes. A case in a deck has no tree."""

    scenario: Node
    case: Node | None

    def root(self, path: NumberPath) -> Node:
        """Return the tree of the document that contains a number."""
        return (self.case or self.scenario) if path.of_case else self.scenario


def number_path(text: str, trees: Trees, place: Place | None = None) -> NumberPath:
    """Return the path to a number that is named by a text such as `shifts.1.overlap`.

    Parameters
    ----------
    text : str
        Keys, and numbers of list items from 1, separated by points; optionally a unit, as in
        `[rpm]`. The scenario is searched first, then the case. `D1.ratio`, `P1.teeth.sun` and
        `engine.inertia` have the same meaning as in a sweep of a case.
    trees : Trees
    place : Place, optional
        Place of the text, for messages.

    Raises
    ------
    ReadError
        If the number does not exist; the message names the nearest.
    """
    typed, unit = with_unit(text)
    try:
        parts = split(typed)
        path = _path(parts, trees)
        root = _spelled_out(trees.root(path), path.keys)
        # Keys such as `mechanisms`, added in front, have the position of the first part.
        before = [parts[0]] * (len(path.keys) - len(parts))
        typed_at = zip(path.keys, [*before, *parts], strict=True)
        node = find_node(root, [PathPart(key, part.at) for key, part in typed_at])
        if node is not None:
            number_of(node)
        else:
            _check_given(path, parts[-1], root)
    except ValueError as error:
        raise refusal(f"{quoted(written(path.keys))} {error}", place, 0) from None
    except NoValueError as error:
        raise refusal(str(error), place, error.at) from None
    return path._replace(unit=unit or "")


def _check_given(path: NumberPath, last: PathPart, root: Node) -> None:
    owner = child(root, path.keys[0])
    if owner and path.keys[0] in _ALL_GIVEN and not path.of_case:
        hint = nearest(path.keys[-1], keys_of(owner))
        raise NoValueError(f"the scenario has no {quoted(written(path.keys))}{hint}", last.at)


def _path(parts: Sequence[PathPart], trees: Trees) -> NumberPath:
    """Return the path in the scenario or case that keys, possibly abbreviated, lead to."""
    keys = tuple(part.name for part in parts)
    of_scenario, of_case = keys_of(trees.scenario), keys_of(trees.case) if trees.case else []
    if keys[0] in of_scenario:
        return NumberPath(keys, of_case=False)
    if keys[0] in of_case:
        return NumberPath(keys, of_case=True)
    for other in in_document(keys):
        if trees.case and _leads(trees.case, other):
            return NumberPath(other, of_case=True)
    known = [*of_scenario, *(key for key in of_case if key not in of_scenario)]
    message = f"neither the scenario nor its case has a key {quoted(keys[0])}"
    if trees.case is None:
        known, message = of_scenario, f"the scenario has no key {quoted(keys[0])}"
        message += "; to vary numbers of a deck, convert it to YAML with `vstatics convert`"
    raise NoValueError(message + nearest(keys[0], known), parts[0].at)


def _leads(root: Node, keys: Keys) -> bool:
    """Return whether all keys except the last exist; for inertias, also the last must exist."""
    node: Node | None = root
    for key in keys if keys[0] in BODIES else keys[:-1]:
        node = node and child(node, key)
    return node is not None


def _spelled_out(root: Node, keys: Keys) -> Node:
    """Return the tree with a short form on the path replaced by the full mapping."""
    if len(keys) < 3 or keys[0] not in _SPELLED or not isinstance(root, Mapping):
        return root
    node = child(root, keys[0])
    short = node and child(node, keys[1])
    key = _SPELLED[keys[0]].get(type(short)) if short else None
    if not (node and short and key):
        return root
    if isinstance(short, Listing) and keys[2].isdigit():
        return root
    whole = Mapping([(Scalar(key, short.line, short.column), short)], short.line, short.column)
    return _with(_at(root), keys[0], _with(_at(node), keys[1], whole))


def _at(node: Node) -> Mapping:
    assert isinstance(node, Mapping)  # noqa: S101 - names only lead into mappings
    return node


def _with(node: Mapping, name: str, value: Node) -> Mapping:
    entries = [(key, value if key.text == name else old) for key, old in node.entries]
    return node._replace(entries=entries)


def written_number(path: NumberPath, trees: Trees) -> WrittenNumber | None:
    """Return a number as written in the document.

    Return None if the key is missing.
    """
    root = _spelled_out(trees.root(path), path.keys)
    node = find_node(root, [PathPart(key, 0) for key in path.keys])
    return None if node is None else number_of(node)


def with_numbers(trees: Trees, paths: Sequence[NumberPath], values: Sequence[float]) -> Trees:
    """Return the documents with the numbers at some paths replaced."""
    scenario, case = trees
    for path, value in zip(paths, values, strict=True):
        text = number_text(value, path.unit)
        if path.of_case and case is not None:
            case = replaced(_spelled_out(case, path.keys), path.keys, text)
        else:
            scenario = replaced(_spelled_out(scenario, path.keys), path.keys, text)
    return Trees(scenario, case)


def sample_unit(scenario: Node, text: str) -> str:
    """Return the first unit in a number's distribution under `samples`; "" if missing."""
    of_path = child(scenario, "samples")
    nodes = [of_path and child(of_path, text)]
    while nodes:
        match nodes.pop():
            case Mapping() as node:
                nodes += [value for _, value in node.entries]
            case Listing() as node:
                nodes += node.items
            case Scalar() as node:
                with suppress(ValueError):
                    if unit := number_of(node).unit:
                        return unit
    return ""


def in_si(unit: str) -> str:
    """Return the SI unit of the quantity that a unit measures, or an unknown unit unchanged.

    >>> in_si("kN*m"), in_si("rpm")
    ('N*m', 'rad/s')
    """
    with suppress(ValueError):
        measure = in_any_unit(f"1 {unit}", tuple(UNIT_OF)).measure
        return UNIT_OF[measure] if measure else unit
    return unit
