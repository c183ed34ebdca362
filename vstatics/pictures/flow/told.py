"""What a script needs to let a power flow follow, as plain data.

A node is told by its kind and name, ``link sun``; a spring by its number from 0, a port by that
of its link, or as ``port output``.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from vstatics.flow.circulation import Node
from vstatics.flow.one_piece import pieces_of
from vstatics.flow.power_flow import GearFlow
from vstatics.pictures.flow.graph import Band, EndPort
from vstatics.pictures.flow.places import Box
from vstatics.pictures.flow.texts import FlowTexts
from vstatics.pictures.sheet.pen import known
from vstatics.pictures.sheet.style import Style
from vstatics.statics.state import GearState


def told_node(node: Node) -> str:
    """The name of a node for a script.

    >>> told_node(Node("link", 2, "sun")), told_node(Node("port", 3, "output"))
    ('link sun', 'port output')
    """
    if node.kind == "spring":
        return f"spring {node.number - 1}"
    if node.kind == "port" and node.name != "output":
        return f"port {node.number}"
    return f"{node.kind} {node.name}"


def told_nodes(nodes: Iterable[Node]) -> list[str]:
    """The names of several."""
    return [*map(told_node, nodes)]


def told_band(band: Band, texts: FlowTexts) -> dict[str, Any]:
    """Its nodes, those of its loop, its power."""
    return {
        "nodes": told_nodes((band.source, *band.between, band.target)),
        "loop": None if band.loop is None else told_nodes(texts.side.loops[band.loop].nodes),
        "power": band.power,
    }


def told_port(link: Node, port: EndPort, texts: FlowTexts) -> dict[str, Any]:
    """Its link, and itself or the band that goes on elsewhere."""
    own = {"port": told_node(port.node), "power": port.power}
    told = own if port.cut is None else told_band(port.cut, texts)
    return {"link": told_node(link), "enters": port.enters, **told}


def told_run(box: Box) -> str:
    """A run by its first node."""
    return told_node(box.cell.run[0])


def told_gear(flow: GearFlow, state: GearState, style: Style) -> dict[str, Any]:
    """What all parts of the picture of a gear share."""
    side = flow.shown
    assert side is not None  # noqa: S101 - there is no picture, then
    return {
        "gear": flow.gear,
        "kilowatts": known(flow.kilowatts),
        "unit": style.text("kW"),
        "ways": [style.text("in"), style.text("out")],
        "ports": [side.entering, side.leaving, side.lost],
        "circulating": known(side.circulating),
        "locked": [
            {"nodes": told_nodes(loop.nodes), "power": loop.power} for loop in side.locked_in
        ],
        "pieces": {told_node(node): piece for node, piece in pieces_of(state).items()},
    }
