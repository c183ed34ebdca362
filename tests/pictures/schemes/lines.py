"""Wires in the SVG of stick diagrams and structures, and which of them touch."""

import re
from itertools import combinations, pairwise
from typing import NamedTuple
from xml.etree import ElementTree as ET

import networkx as nx

from tests.pictures.schemes.axes.boxes import of_class, points


class Line(NamedTuple):
    """Upper left and lower right end of a level or upright line [pt]."""

    x: float
    y: float
    x2: float
    y2: float


def strokes(path: ET.Element) -> list[tuple[tuple[float, float], tuple[float, float]]]:
    """The ends of each line of a path, without the gaps between its parts."""
    parts = [ET.Element("path", d=f"M{part}") for part in path.attrib["d"].split("M")[1:]]
    return [ends for part in parts for ends in pairwise(points(part))]


def lines_of(path: ET.Element) -> list[Line]:
    assert {*re.findall("[A-Za-z]", path.attrib["d"])} <= {"M", "L"}
    return [
        Line(min(x, x2), min(y, y2), max(x, x2), max(y, y2)) for (x, y), (x2, y2) in strokes(path)
    ]


def wires(root: ET.Element) -> dict[str, list[Line]]:
    """The lines of each link, by its name."""
    found: dict[str, list[Line]] = {}
    for link in of_class(root, "link"):
        own = found.setdefault(link.attrib["data-name"], [])
        own += [line for path in of_class(link, "wire") for line in lines_of(path)]
    return found


def touch(one: Line, other: Line, by: float = 0.05) -> bool:
    level = one.x <= other.x2 + by and other.x <= one.x2 + by
    return level and one.y <= other.y2 + by and other.y <= one.y2 + by


def crossings(root: ET.Element) -> int:
    own = wires(root)
    return sum(
        touch(first, second)
        for one, other in combinations(own, 2)
        for first in own[one]
        for second in own[other]
    )


def bridges(root: ET.Element) -> int:
    return len(of_class(root, "crossing"))


def assert_connected(root: ET.Element) -> None:
    """From each line of a link one comes to all others, but in the housing."""
    for link, lines in wires(root).items():
        graph: nx.Graph[int] = nx.empty_graph(len(lines))
        pairs = combinations(range(len(lines)), 2)
        graph.add_edges_from((a, b) for a, b in pairs if touch(lines[a], lines[b]))
        assert link == "housing" or not lines or nx.is_connected(graph), link
