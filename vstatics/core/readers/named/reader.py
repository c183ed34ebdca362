"""Readers of cases in YAML and JSON, and of other YAML documents: bytes -> nodes -> values."""

from __future__ import annotations

from typing import Any

from vstatics.core.annexes import KEYS, not_installed
from vstatics.core.errors import Problem, ReadError
from vstatics.core.model.carried import installed_keys
from vstatics.core.model.keys import CASE, with_carried, with_masses
from vstatics.core.model.shape import ByKey
from vstatics.core.readers.named.arguments import arguments, read_with_stand_ins
from vstatics.core.readers.named.compounds import meant_key
from vstatics.core.readers.named.nodes import (
    DocumentText,
    Mapping,
    Node,
    Spot,
    Spots,
    decode,
    is_null,
)
from vstatics.core.readers.named.walk import Walk
from vstatics.core.readers.reading import Reading, finish

_CORE_KEYS = (*(key.name for key in CASE.keys), "elements", "losses", "mesh_efficiency")
"""Keys of a case that the core declares."""


def read_case_tree(root: Node, document: DocumentText) -> Reading:
    """Read the case in a tree of nodes.

    Parameters
    ----------
    root : Node
    document : DocumentText
        Text of the tree, with problems found so far.

    Raises
    ------
    ReadError
        The error contains every problem that does not follow from another.
    """
    expected = "a case: a mapping with `elements`, `mechanisms`, `springs`, `inertias` or `masses`"
    root = document.mapping(within_result(root), expected)
    walk = Walk(Spots(document))
    given = {key.text for key, _ in root.entries}
    masses = any(
        key.text in ("springs", "inertias", "masses")
        and not is_null(value)
        and (not isinstance(value, Mapping) or bool(value.entries))
        for key, value in root.entries
    )
    root, case = _with_annexes(root, document)
    shape = with_masses(case) if masses else case
    mistyped = given.difference(_CORE_KEYS, KEYS)
    if "elements" in given or any(
        "`elements`" in meant_key(document, key.text, _CORE_KEYS)
        for key, value in root.entries
        if key.text in mistyped and isinstance(value, Mapping)
    ):
        from vstatics.core.readers.named.drawing import read_drawing  # few cases need it

        return read_drawing(root, walk, shape)
    gathered = None
    if masses:
        from vstatics.core.readers.named.joined_links import gathered_links, is_listed, loose_links

        gathered = None if is_listed(root) else gathered_links(root, walk)
    values = walk.read(Spot((), "", root), shape)
    parts = arguments(values, walk)
    problems = [*document.problems, *document.warnings]
    if gathered is not None:
        parts["links"] = len(gathered)
        problems = [*problems, *loose_links(root, values, gathered, parts["gears"], walk.spots)]
        walk.spots.unreadable += [] if gathered else [("links",), ("input",), ("output",)]
    return finish(parts, problems, read_with_stand_ins(walk.spots.unreadable), walk.spots.locate)


def _with_annexes(root: Mapping, document: DocumentText) -> tuple[Mapping, ByKey]:
    """Return the document without keys of missing annexes, and a shape with the other keys.

    Keys of annexes that are not installed are omitted with a warning. Annexes are imported only if
    the document contains their keys, or an unknown key, whose hint needs the names of all keys.
    """
    unknown = {key.text for key, _ in root.entries}.difference(_CORE_KEYS)
    if not unknown:
        return root, CASE
    mistyped = not unknown <= KEYS.keys()
    keys = installed_keys(key for key in KEYS if mistyped or key in unknown)
    missing = (unknown & KEYS.keys()) - {key.shape.name for key in keys}
    for key, _ in root.entries:
        if key.text in missing:
            place = document.source.place(key.line, key.column)
            message = not_installed(key.text, KEYS[key.text])
            document.problems.append(Problem("W807", message, (), place))
    entries = [entry for entry in root.entries if entry[0].text not in missing]
    return root._replace(entries=entries), with_carried(CASE, keys)


def within_result(root: Node) -> Node:
    """Return the node of the case in a result or solution, or the node itself if it is a case."""
    entries = {key.text: value for key, value in root.entries} if isinstance(root, Mapping) else {}
    inner = entries.get("case")
    return inner if entries.keys() & {"format", "blanks"} and isinstance(inner, Mapping) else root


def read_document(data: bytes, file: str, shape: ByKey, expected: str) -> tuple[Any, Spots]:
    """Read a document in YAML, and return its values and their places.

    Parameters
    ----------
    data : bytes
        The content of a file.
    file : str
        Name of the file, for messages.
    shape : ByKey
        Declared shape of the document; its `make` creates the result.
    expected : str
        Kind of the document, for messages.

    Raises
    ------
    ReadError
        The error contains every problem and its place.

    Examples
    --------
    >>> from vstatics.core.model.keys import LOAD
    >>> load, spots = read_document(b"torque: 200 N*m", "load.yaml", LOAD, "a load")
    >>> load, spots.place(("torque",)).column
    (Load(speed=None, torque=200.0, power=None), 9)
    """
    from vstatics.core.readers.named.yaml_nodes import yaml_tree  # imported when needed

    document = decode(data, file, expected)
    root = document.mapping(yaml_tree(document), expected)
    spots = Spots(document)
    values = Walk(spots).read(Spot((), "", root), shape)
    if document.problems:
        raise ReadError(
            sorted(
                document.problems, key=lambda problem: problem.place[1:3] if problem.place else ()
            )
        )
    return values, spots
