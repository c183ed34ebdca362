"""The power of gears as plain data for JSON."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from vstatics.flow.circulation import Loop, Node
from vstatics.flow.power import GearFlow, PowerFlow

VERSION = 1
CONVENTIONS = {
    "powers": "relative to the power at the input link, in their real direction; times "
    "input_link_kW they are in kW",
    "members": "above 0: from the link to the member",
    "throughput": "what enters a node; of a port what passes it",
    "forward": "the edges less all loops",
    "loops": "circulating power",
    "locked_in": "loops within what turns as one piece, which do not count",
    "null": "does not exist, or is not determined",
}


def document(name: str, found: Sequence[GearFlow]) -> dict[str, Any]:
    """The power of gears as a plain mapping, ready for JSON; NaN becomes None.

    Parameters
    ----------
    name : str
        Of the case.
    """
    return {
        "format": "vstatics-flow",
        "version": VERSION,
        "conventions": CONVENTIONS,
        "case": name,
        "gears": [
            {
                "gear": flow.gear,
                "note": flow.note,
                "input_link_kW": _number(flow.kilowatts),
                "ideal": _side(flow.ideal),
                "lossy": _side(flow.lossy),
            }
            for flow in found
        ],
    }


def _side(side: PowerFlow | None) -> dict[str, Any] | None:
    if side is None:
        return None
    passing, shares = side.throughput, side.shares
    return {
        "entering": _number(side.entering),
        "leaving": _number(side.leaving),
        "lost": _number(side.lost),
        "balance": _number(side.balance),
        "circulating": _number(side.circulating),
        "circulating_share": _number(side.circulating_share),
        "throughput": [_node(node) | {"power": _number(passing[node])} for node in passing],
        "losses": [
            _node(node) | {"power": _number(loss), "share": _number(shares[node])}
            for node, loss in side.losses.items()
        ],
        "members": [
            _node(device) | {"member": member, "link": link, "power": _number(power)}
            for device, member, link, power in side.members
        ],
        "edges": _edges(side.edges),
        "forward": _edges(side.forward),
        "loops": _loops(side.loops),
        "locked_in": _loops(side.locked_in),
    }


def _edges(edges: Sequence[Any]) -> list[dict[str, Any]]:
    return [
        {"from": _node(one.source), "to": _node(one.target), "power": one.power} for one in edges
    ]


def _loops(loops: Sequence[Loop]) -> list[dict[str, Any]]:
    return [{"power": loop.power, "nodes": [_node(node) for node in loop.nodes]} for loop in loops]


def _node(node: Node) -> dict[str, Any]:
    return node._asdict()


def _number(value: float) -> float | None:
    return value if math.isfinite(value) else None
