"""Reads cases in YAML and JSON: bytes -> tree of nodes -> Transmission."""

from __future__ import annotations

from vstatics.readers.named.arguments import arguments, untold
from vstatics.readers.named.nodes import Found, Mapping, Node, decode, what
from vstatics.readers.named.shape import CASE
from vstatics.readers.named.spots import Spot, Spots
from vstatics.readers.named.walk import Walk
from vstatics.readers.reading import Reading, finish


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
    from vstatics.readers.named.yaml_nodes import yaml_tree  # yaml costs start-up time

    found = decode(data, file)
    return _reading(yaml_tree(found), found)


def read_json(data: bytes, file: str) -> Reading:
    """Read a case in JSON, of the same shape as in YAML.

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
    """
    from vstatics.readers.named.json_nodes import json_tree  # json likewise

    found = decode(data, file)
    return _reading(json_tree(found), found)


def _reading(root: Node, found: Found) -> Reading:
    """The case of a tree of nodes."""
    if not isinstance(root, Mapping):
        expected = "expected a case: a mapping with `elements` or `mechanisms`, and `gears`"
        found.stop(f"read {what(root)}, {expected}", root.line, root.column)
    root = _case(root)
    walk = Walk(Spots(found))
    if any(key.text == "elements" for key, _ in root.entries):
        from vstatics.readers.named.drawing import read_drawing  # others do without

        return read_drawing(root, walk)
    values = walk.read(Spot((), "", root), CASE)
    return finish(
        arguments(values, walk), found.problems, untold(walk.spots.unreadable), walk.spots.locate
    )


def _case(root: Mapping) -> Mapping:
    """The case itself, or that of a JSON result: so a result can be run again, as a listing can."""
    entries = {key.text: value for key, value in root.entries}
    inner = entries.get("case")
    return inner if "format" in entries and isinstance(inner, Mapping) else root
