"""Whether a gearbox can be drawn without shafts that cross."""

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
"""A vertex beside the links and the housing."""
MOST_ENDS = 2
"""Links that an elastic device joins; one of a single link stands on the housing."""


@refusing()
def box_is_planar(case: Transmission) -> bool:
    """Whether the graph of links, housing and axis is planar.

    Its edges are sun to carrier and carrier to ring of each set, each shift element, and the
    axis to the housing, the input and each output: these leave at the ends of the axis, where
    they, the axis and the housing lie on one face. Of a pair of gears both links go to the
    housing, which holds their shafts; wheels that share planets are sets of one carrier.

    Parameters
    ----------
    case : Transmission
        Any one.

    Returns
    -------
    bool

    Raises
    ------
    CaseError
        If the library for it is missing.

    Examples
    --------
    >>> from vstatics.core.model.transmission import Gear, Mechanism
    >>> box_is_planar(Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear()]))
    True
    """
    own = on_own_links(case).case
    ports = {own.input, own.output, *own.outputs}
    for gear in own.gears:
        ports |= {own.gear_input(gear), own.gear_output(gear)}
    edges: list[Edge] = [(AXIS, port) for port in (HOUSING, *ports)]
    for one in own.mechanisms:
        edges += [(one.first, one.third), (one.third, one.second)]
    edges += [element.links for element in own.shift_elements]
    for spring in own.springs:
        edges += pairwise([*spring.form, HOUSING][:MOST_ENDS])
    return is_planar(edges)


def is_planar(edges: Iterable[Edge]) -> bool:
    """Whether a graph is planar; an edge may come twice, or have two equal ends.

    Examples
    --------
    >>> five = range(5)
    >>> is_planar((one, other) for one in five for other in five), is_planar([(0, 1), (1, 0)])
    (False, True)
    """
    require("boxes", "whether a gearbox is planar")
    import networkx as nx  # an extra

    graph: nx.Graph[int] = nx.Graph()
    graph.add_edges_from((one, other) for one, other in edges if one != other)
    return bool(nx.check_planarity(graph)[0])
