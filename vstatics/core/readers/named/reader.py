"""Reads cases in YAML and JSON, and other documents in YAML: bytes -> tree of nodes -> values."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from vstatics.core.annexes import KEYS, not_installed
from vstatics.core.errors import Problem, ReadError
from vstatics.core.model.carried import installed_keys
from vstatics.core.model.keys import CASE, with_carried, with_masses
from vstatics.core.model.shape import ByKey
from vstatics.core.readers.named.arguments import arguments, read_with_stand_ins
from vstatics.core.readers.named.nodes import (
    Found,
    Mapping,
    Node,
    Spot,
    Spots,
    decode,
    is_null,
    what,
)
from vstatics.core.readers.named.walk import Walk
from vstatics.core.readers.reading import Reading, finish

if TYPE_CHECKING:
    from vstatics.core.readers import Format

_OF_CORE = {*(key.name for key in CASE.keys), "elements", "losses", "mesh_efficiency"}
"""Keys of a case that the core declares."""


def read_yaml(data: bytes, file: str) -> Reading:
    """Read a case in YAML.

    Parameters
    ----------
    data : bytes
        UTF-8, or another Unicode encoding with its byte order mark.
    file : str
        The name that problems give.

    Raises
    ------
    ReadError
        With every problem that can be told from the others.

    Examples
    --------
    >>> text = b'''
    ... links: [sun, ring, carrier]
    ... mechanisms: {set: {first: sun, second: ring, third: carrier, ratio: -96/39}}
    ... shift_elements: {brake: [ring, housing]}
    ... gears: {"1": {engaged: [brake]}}
    ... '''
    >>> read_yaml(text, "case.yaml").case.mechanisms[0].links
    (1, 2, 3)
    """
    found = decode(data, file)
    return read_case_tree(_tree(found, "yaml"), found)


def read_json(data: bytes, file: str) -> Reading:
    """Read a case in JSON, of the same shape as in YAML; see `read_yaml`."""
    found = decode(data, file)
    return read_case_tree(_tree(found, "json"), found)


def _tree(found: Found, form: Format) -> Node:
    """The tree of a text in YAML or JSON, which cost start-up time."""
    if form == "json":
        from vstatics.core.readers.named.json_nodes import json_tree

        return json_tree(found)
    from vstatics.core.readers.named.yaml_nodes import yaml_tree

    return yaml_tree(found)


def case_tree(found: Found, form: Format) -> Node:
    """The case in YAML or JSON as a tree of nodes.

    Raises
    ------
    ReadError
        If it is no such document.
    """
    root = _tree(found, form)
    return _case(root) if isinstance(root, Mapping) else root


def read_case_tree(root: Node, found: Found) -> Reading:
    """The case of a tree of nodes.

    Parameters
    ----------
    root : Node
    found : Found
        The text, with what was found wrong in it so far.

    Raises
    ------
    ReadError
        With every problem that can be told from the others.
    """
    expected = "a case: a mapping with `elements`, `mechanisms`, `springs`, `inertias` or `masses`"
    root = _case(_mapping(root, found, expected))
    walk = Walk(Spots(found))
    given = {key.text for key, _ in root.entries}
    masses = _has_masses(root)
    root, case = _with_annexes(root, found)
    shape = with_masses(case) if masses else case
    if "elements" in given:
        from vstatics.core.readers.named.drawing import read_drawing  # others do without

        return read_drawing(root, walk, shape)
    if masses:
        return _with_masses(root, walk, shape)
    values = walk.read(Spot((), "", root), shape)
    return finish(
        arguments(values, walk),
        found.problems,
        read_with_stand_ins(walk.spots.unreadable),
        walk.spots.locate,
    )


def _with_annexes(root: Mapping, found: Found) -> tuple[Mapping, ByKey]:
    """Return the document and the shape of a case with the keys of annexes that it needs.

    Keys of annexes that are not installed are left out, with a warning. No annex is asked for a
    document whose keys are all of the core; an unknown key needs the names of all keys.
    """
    unknown = {key.text for key, _ in root.entries} - _OF_CORE
    if not unknown:
        return root, CASE
    mistyped = not unknown <= KEYS.keys()
    keys = installed_keys(key for key in KEYS if mistyped or key in unknown)
    missing = (unknown & KEYS.keys()) - {key.shape.name for key in keys}
    for key, _ in root.entries:
        if key.text in missing:
            place = found.source.place(key.line, key.column)
            message = not_installed(key.text, KEYS[key.text])
            found.problems.append(Problem("W807", message, (), place))
    entries = [entry for entry in root.entries if entry[0].text not in missing]
    return root._replace(entries=entries), with_carried(CASE, keys)


def _has_masses(root: Mapping) -> bool:
    """Whether springs or inertias are listed, so that a case may go without the rest."""
    return any(
        key.text in ("springs", "inertias", "masses")
        and not is_null(value)
        and (not isinstance(value, Mapping) or bool(value.entries))
        for key, value in root.entries
    )


def _with_masses(root: Mapping, walk: Walk, shape: ByKey) -> Reading:
    """A case without elements, whose devices or inertias may tell its links."""
    from vstatics.core.readers.named.joined_links import gathered_links, is_listed, loose_links

    gathers = not is_listed(root)
    gathered = gathered_links(root, walk) if gathers else []
    values = walk.read(Spot((), "", root), shape)
    parts = arguments(values, walk)
    loose: list[Problem] = []
    if gathers:
        parts["links"] = len(gathered)
        loose += loose_links(root, values, gathered, parts["gears"], walk.spots)
        walk.spots.unreadable += [] if gathered else [("links",), ("input",), ("output",)]
    problems = [*walk.spots.found.problems, *loose]
    return finish(parts, problems, read_with_stand_ins(walk.spots.unreadable), walk.spots.locate)


def _mapping(root: Node, found: Found, expected: str) -> Mapping:
    if not isinstance(root, Mapping):
        found.stop(f"read {what(root)}, expected {expected}", root.line, root.column)
    return root


def _case(root: Mapping) -> Mapping:
    """The case itself, or that of a JSON result or solution: so these can be run, as a listing."""
    entries = {key.text: value for key, value in root.entries}
    inner = entries.get("case")
    return inner if entries.keys() & {"format", "blanks"} and isinstance(inner, Mapping) else root


def read_document(data: bytes, file: str, shape: ByKey, expected: str) -> tuple[Any, Spots]:
    """Read a document in YAML: its values, as `make` of the shape gives them, and their places.

    Parameters
    ----------
    data : bytes
    file : str
        Its name, for messages.
    shape : ByKey
    expected : str
        What it is, for messages.

    Raises
    ------
    ReadError
        With every problem and its place.

    Examples
    --------
    >>> from vstatics.core.model.keys import LOAD
    >>> load, spots = read_document(b"torque: 200 N*m", "load.yaml", LOAD, "a load")
    >>> load, spots.place(("torque",)).column
    (Load(speed=None, torque=200.0, power=None), 9)
    """
    found = decode(data, file, expected)
    root = _mapping(_tree(found, "yaml"), found, expected)
    spots = Spots(found)
    values = Walk(spots).read(Spot((), "", root), shape)
    if found.problems:
        raise ReadError(sorted(found.problems, key=lambda one: one.place[1:3] if one.place else ()))
    return values, spots
