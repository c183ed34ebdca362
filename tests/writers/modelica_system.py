"""The text of a Modelica model as a linear system: its equations, from the components' own.

What the components of the standard library mean is told by their documentation: a torque is that
which a flange takes in, a clutch that holds has no relative speed, an open one no torque.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterator, Mapping
from typing import NamedTuple

import numpy as np

IDENTIFIER = r"(?:'[^']*'|\w+)"
DECLARED = re.compile(
    rf"^ +(?P<kind>[A-Z][\w.]+) (?P<name>{IDENTIFIER})(?:\((?P<given>.*?)\))? ?\"?.*;$"
)
CONNECTED = re.compile(rf"^ +connect\(({IDENTIFIER})\.(\w+), ({IDENTIFIER}(?:\.flange)?)\);$")
GIVEN = re.compile(r"\b(\w+) = ([-0-9.e]+)\b")

Row = Mapping[tuple[str, str], float]
"""Coefficients by ("w", flange) and ("tau", flange)."""


class Component(NamedTuple):
    """What a line of the model declares."""

    kind: str
    numbers: Mapping[str, float]


class Written(NamedTuple):
    """The model of a package."""

    links: list[str]
    components: dict[str, Component]
    nodes: dict[str, str]
    """By the name of a flange, ``P1.sun``: the link, or ``housing.flange``."""


def parsed(text: str) -> Written:
    """The declarations and connections of the last model of a package."""
    links, components, nodes = [], {}, {}
    for line in text[text.index("  model Gearbox ") :].splitlines():
        if connected := CONNECTED.match(line):
            nodes[f"{connected[1]}.{connected[2]}"] = connected[3]
        elif found := DECLARED.match(line):
            kind, given = found["kind"].rpartition(".")[2], found["given"] or ""
            if kind == "Flange_a":
                links.append(found["name"])
            else:
                numbers = {key: float(number) for key, number in GIVEN.findall(given)}
                components[found["name"]] = Component(kind, numbers)
    return Written(links, components, nodes)


def solved(written: Written, holding: set[str], ends: tuple[str, str]) -> dict[str, float]:
    """Speeds of links and torques of flanges, for a speed and a torque of 1 at the input.

    Parameters
    ----------
    holding : set of str
        Components that hold.
    ends : (str, str)
        Input and output.
    """
    rows: list[tuple[Row, float]] = [({("w", "housing.flange"): 1}, 0.0)]
    for name, component in written.components.items():
        rows += [(row, 0.0) for row in _rows(name, component, holds=name in holding)]
    balance: dict[str, dict[tuple[str, str], float]] = defaultdict(dict)
    for flange, node in written.nodes.items():
        rows.append(({("w", flange): 1, ("w", node): -1}, 0.0))
        balance[node]["tau", flange] = 1
    for link in written.links:
        balance[link]["tau", link] = -1  # from outside
        if link not in ends:
            rows.append(({("tau", link): 1}, 0.0))
        rows.append((balance[link], 0.0))
    rows += [({(what, ends[0]): 1}, 1.0) for what in ("w", "tau")]
    unknowns = {key: 0 for row, _ in rows for key in row}
    unknowns = {key: place for place, key in enumerate(unknowns)}
    matrix = np.zeros((len(rows), len(unknowns)))
    for place, (row, _) in enumerate(rows):
        for key, coefficient in row.items():
            matrix[place, unknowns[key]] += coefficient
    right = np.array([number for _, number in rows])
    values, _, rank, _ = np.linalg.lstsq(matrix, right, rcond=1e-10)
    assert rank == len(unknowns)
    assert np.abs(matrix @ values - right).max() < 1e-9
    return {" ".join(key): float(value) for key, value in zip(unknowns, values, strict=True)}


def _rows(  # noqa: C901 - a table
    name: str, one: Component, *, holds: bool
) -> Iterator[Row]:
    """The equations of a component."""

    def w(flange: str) -> tuple[str, str]:
        return "w", f"{name}.{flange}"

    def tau(flange: str) -> tuple[str, str]:
        return "tau", f"{name}.{flange}"

    if one.kind == "IdealGear":
        ratio = one.numbers["ratio"]
        yield {w("flange_a"): 1, w("flange_b"): -ratio}
        yield {tau("flange_a"): ratio, tau("flange_b"): 1}
    elif one.kind == "IdealPlanetary":
        ratio = one.numbers["ratio"]
        yield {w("carrier"): 1 + ratio, w("sun"): -1, w("ring"): -ratio}
        yield {tau("ring"): 1, tau("sun"): -ratio}
        yield {tau("carrier"): 1, tau("sun"): 1 + ratio}
    elif one.kind == "ThreeLink":
        u = one.numbers["u"]
        yield {w("first"): 1, w("third"): u - 1, w("second"): -u}
        yield {tau("second"): 1, tau("first"): u}
        yield {tau("third"): 1, tau("first"): 1 - u}
    elif one.kind in ("Clutch", "OneWayClutch"):
        yield {tau("flange_a"): 1, tau("flange_b"): 1}
        yield {w("flange_a"): 1, w("flange_b"): -1} if holds else {tau("flange_a"): 1}
    elif one.kind == "Brake":
        yield {w("flange_a"): 1} if holds else {tau("flange_a"): 1}
    elif one.kind == "SpringDamper":  # at mean speeds
        yield {tau("flange_a"): 1, tau("flange_b"): 1}
        yield {w("flange_a"): 1, w("flange_b"): -1}
    elif one.kind.startswith(("ElasticLinks", "SharedInertia")):
        parts = [number for key, number in one.numbers.items() if key.startswith("k")]
        flanges = [f"flange{place}" for place in range(1, len(parts) + 1)]
        if one.kind.startswith("SharedInertia"):
            yield from ({tau(flange): 1} for flange in flanges)
        else:
            yield {w(flange): part for flange, part in zip(flanges, parts, strict=True)}
            for flange, part in zip(flanges[1:], parts[1:], strict=True):
                yield {tau(flange): parts[0], tau(flanges[0]): -part}
    elif one.kind == "Inertia":
        yield {tau("flange_a"): 1}  # nothing accelerates
    else:
        assert one.kind in ("Fixed", "RealInput")
