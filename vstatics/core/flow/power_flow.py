"""Power flow of a gear as data: graph, losses, recirculating power, ports.

Powers are relative to the power at the input link. Power is conserved: ``entering = leaving +
sum(losses)``, except for rounding. The edges are the sum of transmitted power (`forward`, without
cycles) and recirculating power (`loops`).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

from vstatics.core.extras import higher
from vstatics.core.flow.circulation import Edge, Loop, Node
from vstatics.core.flow.graph_cycles import edges_on_cycles
from vstatics.core.flow.teeth import ToothPower
from vstatics.core.statics.status import Status
from vstatics.core.tables.answer import Flat, defined, json_keys
from vstatics.core.tables.html import shown as in_notebook
from vstatics.core.tables.ports import PortTable


class MemberPower(NamedTuple):
    """Power that a link gives to a member of a device; negative if the link receives power."""

    device: Flat[Node]
    member: str
    """Member of a mechanism or gear set, ``first`` or ``second`` for a shift element.

    For a spring, the name of the link.
    """
    link: str
    power: float
    """Power; NaN if indeterminate. [-]"""


class NodePower(NamedTuple):
    """Power through a node [-]; NaN if indeterminate."""

    node: Flat[Node]
    power: float


class NodeLoss(NamedTuple):
    """Power lost in a node."""

    node: Flat[Node]
    power: float
    share: float
    """Loss as a fraction of all losses. [-]"""


@defined("side")
@json_keys(
    *("entering", "leaving", "lost", "balance"),
    *("circulating", "circulating_share", "doubtful"),
    throughput="node_powers",
    losses="node_losses",
    members="members",
    teeth="teeth",
    edges="edges",
    forward="forward",
    loops="loops",
    locked_in="locked_in",
)
class PowerFlow(NamedTuple):
    """Power flow of a gear, without or with losses, relative to the power at the input link.

    Directions are real. For example, when coasting the power 1 leaves at the input.
    """

    edges: tuple[Edge, ...]
    """All powers that are determinate and larger than rounding errors."""
    forward: tuple[Edge, ...]
    """Transmitted power: the edges minus all loops, a graph without cycles."""
    members: tuple[MemberPower, ...]
    """Powers of shift elements that carry torque or drag, of mechanisms and of springs."""
    throughput: Mapping[Node, float]
    """Power that enters each node, or the magnitude of the power of a port; NaN if indeterminate.

    [-]
    """
    losses: Mapping[Node, float]
    """Loss of each mechanism, each link with drag, and each shift element with drag or slip. [-]

    The mapping is empty in a flow without losses.
    """
    entering: float
    """Power that enters through all ports. [-]"""
    leaving: float
    """Power that leaves through all ports. [-]"""
    loops: tuple[Loop, ...]
    """Cycles of recirculating power, without indeterminate powers."""
    locked_in: tuple[Loop, ...]
    """Cycles of power within parts that rotate as a block.

    These cycles do not count as recirculating power, because nothing moves inside such parts.
    """
    teeth: tuple[ToothPower, ...] = ()
    """Rolling power of each mechanism that can have teeth, and of each mesh."""

    @property
    def unknown(self) -> tuple[Node, ...]:
        """Nodes with indeterminate power."""
        return tuple(node for node, value in self.throughput.items() if math.isnan(value))

    @property
    def lost(self) -> float:
        """Sum of all losses [-]."""
        return math.fsum(self.losses.values())

    @property
    def balance(self) -> float:
        """Input power minus output power and losses [-], which is 0 except for rounding."""
        return self.entering - self.leaving - self.lost

    @property
    def shares(self) -> dict[Node, float]:
        """Each loss as a fraction of all losses [-]; NaN if all losses are 0."""
        lost = self.lost
        return {node: loss / lost if lost else math.nan for node, loss in self.losses.items()}

    @property
    def node_powers(self) -> list[NodePower]:
        """Power through each node, as a list."""
        return [NodePower(*item) for item in self.throughput.items()]

    @property
    def node_losses(self) -> list[NodeLoss]:
        """Loss of each node and its fraction of all losses, as a list."""
        return [NodeLoss(*item, self.shares[item[0]]) for item in self.losses.items()]

    @property
    def circulating(self) -> float:
        """Recirculating power of all loops [-]; NaN if some power is indeterminate."""
        return math.nan if self.unknown else math.fsum(loop.power for loop in self.loops)

    @property
    def doubtful(self) -> float:
        """Recirculating power that can be an artefact of the model [-]; NaN if indeterminate."""
        if self.unknown:
            return math.nan
        return math.fsum(loop.power for loop in self.loops if loop.shared)

    @property
    def circulating_share(self) -> float:
        """Recirculating power divided by all input power [-]; NaN without input power."""
        return self.circulating / self.entering if self.entering else math.nan


@json_keys(
    *("gear", "note"),
    input_link_kW="kilowatts",
    by_convention="by_convention",
    ports="ports",
    ideal="ideal",
    lossy="lossy",
)
class GearFlow(NamedTuple):
    """Power flow of a gear."""

    gear: str
    ideal: PowerFlow | None
    """Flow without losses; None if speeds or torques are contradictory."""
    lossy: PowerFlow | None
    """Flow with losses; None without `ideal`, or if the gear is self-locking."""
    ports: Flat[PortTable]
    """Speed, torque and power of the ports where power enters and leaves."""
    status: Status
    """Reason for a missing flow, or `OK`."""
    by_convention: tuple[Node, ...] = ()
    """Nodes that rotate as a block, and whose power is a convention.

    Statics determines the power into and out of the block, but not the split inside.
    """

    def __repr__(self) -> str:
        """Return a short description: gear, input, output and lost power."""
        side = self.shown
        description = f"in {side.entering:.4g}, out {side.leaving:.4g}" if side else self.note
        lost = f", lost {self.lossy.lost:.3g}" if self.lossy else ""
        return f"<GearFlow {self.gear!r}: {description}{lost}>"

    def _repr_html_(self) -> str:
        return in_notebook(higher("flow_grids")([self]))

    @property
    def kilowatts(self) -> float:
        """Power at the input link [kW], for 1 N*m if the input torque is 0; NaN without a load."""
        return self.ports.scales["kW"]

    @property
    def shown(self) -> PowerFlow | None:
        """Flow with losses or, if that does not exist, without losses."""
        return self.lossy or self.ideal

    def divided(self, side: PowerFlow) -> set[tuple[Node, Node]]:
        """Return the edges of a flow whose power is a convention, as pairs of nodes.

        Such edges begin or end at nodes of `by_convention`. An edge that is the only connection
        between its ends is not included, because it must transmit all power.
        """
        edges = [edge[:2] for edge in side.edges]
        devices = {node for node in self.by_convention if node.kind != "link"}
        return edges_on_cycles(edge for edge in edges if not devices.isdisjoint(edge))

    @property
    def note(self) -> str:
        """Reason for a missing flow; empty if the flow exists."""
        return self.status.english
