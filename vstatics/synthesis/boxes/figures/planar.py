"""Test whether a gearbox can be drawn without crossing shafts (planarity of a graph)."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise

from vstatics.core.arguments import refusing
from vstatics.core.explain.bodies import on_own_links
from vstatics.core.extras import require
from vstatics.core.model.parts import HOUSING
from vstatics.core.model.transmission import Transmission

Edge = tuple[int, int]
AXIS = -1
"""Vertex of the axis of rotation, in addition to the vertices of links and housing."""
MOST_ENDS = 2
"""Number of ends of the edge of a spring: its first two links, or its only link and the housing.
"""


@refusing()
def box_is_planar(case: Transmission) -> bool:
    """Check whether a gearbox can be drawn without crossing shafts.

    The graph of links, housing and axis must be planar. Each gear set has edges from sun to carrier
    and from carrier to ring, and each shift element is an edge. Edges lead from the axis to the
    housing, and to the input and outputs, which leave along the axis. Both links of a gear pair
    have an edge to the housing, which supports the shafts. Gears that share planets count as gear
    sets of one carrier.

    Parameters
    ----------
    case : Transmission
        Any case.

    Returns
    -------
    bool

    Raises
    ------
    CaseError
        If the library networkx is missing.

    Examples
    --------
    >>> from vstatics.core.model.transmission import Gear, Mechanism
    >>> box_is_planar(Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear()]))
    True
    """
    lowered = on_own_links(case).case
    ports = {lowered.input, lowered.output, *lowered.outputs}
    for gear in lowered.gears:
        ports |= {lowered.gear_input(gear), lowered.gear_output(gear)}
    edges: list[Edge] = [(AXIS, port) for port in (HOUSING, *ports)]
    for mechanism in lowered.mechanisms:
        edges += [(mechanism.first, mechanism.third), (mechanism.third, mechanism.second)]
    edges += [element.links for element in lowered.shift_elements]
    for spring in lowered.springs:
        edges += pairwise([*spring.form, HOUSING][:MOST_ENDS])
    return is_planar(edges)


def is_planar(edges: Iterable[Edge]) -> bool:
    """Check whether a graph is planar. Edges can be repeated or have two equal ends.

    Examples
    --------
    >>> five = range(5)
    >>> is_planar((first, second) for first in five for second in five), is_planar([(0, 1), (1, 0)])
    (False, True)
    """
    require("boxes", "whether a gearbox is planar")
    import networkx as nx  # networkx is an optional package

    graph: nx.Graph[int] = nx.Graph()
    graph.add_edges_from((first, second) for first, second in edges if first != second)
    return bool(nx.check_planarity(graph)[0])
