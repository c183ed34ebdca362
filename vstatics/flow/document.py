"""The power of gears as JSON, with all digits."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from vstatics.flow.circulation import Edge, Loop
from vstatics.flow.power_flow import GearFlow, PowerFlow
from vstatics.flow.shared_planets import words
from vstatics.writers.plain_json import plain_data
from vstatics.writers.ports import port_document

FORMAT = "vstatics-flow"
VERSION = 1
CONVENTIONS = {
    "powers": "relative to the power at the input link, in their real direction; times "
    "input_link_kW they are in kW",
    "members": "above 0: from the link to the member",
    "ports": "links with power from outside; the torque of an output is that which it gives to "
    "its load, of another link that which acts on it",
    "throughput": "what enters a node; of a port what passes it",
    "teeth": "power that enters the teeth, against the carrier; of a mechanism as a whole "
    "where there is no mesh",
    "forward": "the edges less all loops",
    "doubtful": "the part of the circulating power that may not be in the metal",
    "loops": "circulating power; a note where it may not be in the metal",
    "locked_in": "loops within what turns as one piece, which do not count",
    "by_convention": "what turns as one piece, and whose part of the power no statics decides",
    "null": "does not exist, or is not determined",
}
SIDE_NUMBERS = (
    *("entering", "leaving", "lost", "balance"),
    *("circulating", "circulating_share", "doubtful"),
)
"""What is told of a side as a whole."""


def document(name: str, gears: Sequence[GearFlow]) -> dict[str, Any]:
    """The power of gears of a case, by its name, as plain data."""
    made: dict[str, Any] = plain_data(
        {
            "format": FORMAT,
            "version": VERSION,
            "conventions": CONVENTIONS,
            "case": name,
            "gears": [
                {
                    "gear": flow.gear,
                    "note": flow.note,
                    "input_link_kW": flow.kilowatts,
                    "by_convention": flow.by_convention,
                    **port_document(flow.ports),
                    "ideal": _side(flow.ideal),
                    "lossy": _side(flow.lossy),
                }
                for flow in gears
            ],
        }
    )
    return made


def _side(side: PowerFlow | None) -> dict[str, Any] | None:
    if side is None:
        return None
    shares = side.shares
    return {
        **{name: getattr(side, name) for name in SIDE_NUMBERS},
        "throughput": [
            node._asdict() | {"power": power} for node, power in side.throughput.items()
        ],
        "losses": [
            node._asdict() | {"power": loss, "share": shares[node]}
            for node, loss in side.losses.items()
        ],
        "members": [
            device._asdict() | {"member": member, "link": link, "power": power}
            for device, member, link, power in side.members
        ],
        "teeth": [
            device._asdict() | {"mesh": mesh, "power": power, "loss": loss}
            for device, mesh, power, loss in side.teeth
        ],
        "edges": _edges(side.edges),
        "forward": _edges(side.forward),
        "loops": _loops(side.loops),
        "locked_in": _loops(side.locked_in),
    }


def _edges(edges: Sequence[Edge]) -> list[dict[str, Any]]:
    return [{"from": one.source, "to": one.target, "power": one.power} for one in edges]


def _loops(loops: Sequence[Loop]) -> list[dict[str, Any]]:
    return [
        {"power": loop.power, "nodes": loop.nodes, "note": words(loop.shared)} for loop in loops
    ]
