"""What is told of the power of a gear: its graph, losses, circulating power, ports."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

from vstatics.core.extras import higher
from vstatics.core.flow.circulation import Edge, Loop, Node
from vstatics.core.flow.graph_cycles import edges_on_cycles
from vstatics.core.flow.teeth import ToothPower
from vstatics.core.statics.status import Status
from vstatics.core.tables.answer import Flat, defined, told
from vstatics.core.tables.html import shown as in_notebook
from vstatics.core.tables.ports import PortTable


class MemberPower(NamedTuple):
    """What a link gives to a member of a device; below 0 where it takes."""

    device: Flat[Node]
    member: str
    """``first`` or ``second`` of a shift element; that of a mechanism or a drawn element; of a
    spring the name of the link."""
    link: str
    power: float
    """NaN where it is not determined. [-]"""


class NodePower(NamedTuple):
    """What goes through a node."""

    node: Flat[Node]
    power: float


class NodeLoss(NamedTuple):
    """What is lost in a node."""

    node: Flat[Node]
    power: float
    share: float
    """Of all losses. [-]"""


@defined("side")
@told(
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
    """The power of a gear, without or with losses, relative to that at the input link.

    Its direction is the real one, also when coasting: then power 1 leaves at the input.
    """

    edges: tuple[Edge, ...]
    """All powers above rounding that are determined."""
    forward: tuple[Edge, ...]
    """The edges less all loops: what is transmitted, a graph without cycles."""
    members: tuple[MemberPower, ...]
    """Of every shift element that is engaged or drags, of every mechanism and every spring."""
    throughput: Mapping[Node, float]
    """What enters a node; of a port what passes it. NaN where it is not determined. [-]"""
    losses: Mapping[Node, float]
    """Of every mechanism and of whatever drags; nothing without losses. [-]"""
    entering: float
    """By all ports. [-]"""
    leaving: float
    """By all ports. [-]"""
    loops: tuple[Loop, ...]
    """Cycles of circulating power, of that which is determined."""
    locked_in: tuple[Loop, ...]
    """Cycles within what turns as one piece: not counted, as nothing moves in them."""
    teeth: tuple[ToothPower, ...] = ()
    """Power against the carrier, of every mechanism that may have teeth and of its meshes."""

    @property
    def unknown(self) -> tuple[Node, ...]:
        """Whatever has a power that is not determined."""
        return tuple(node for node, value in self.throughput.items() if math.isnan(value))

    @property
    def lost(self) -> float:
        """All losses [-]."""
        return math.fsum(self.losses.values())

    @property
    def balance(self) -> float:
        """What enters less what leaves and what is lost [-]: 0 to rounding."""
        return self.entering - self.leaving - self.lost

    @property
    def shares(self) -> dict[Node, float]:
        """Each loss as a part of all losses [-]; NaN where there are none."""
        lost = self.lost
        return {node: loss / lost if lost else math.nan for node, loss in self.losses.items()}

    @property
    def node_powers(self) -> list[NodePower]:
        """The throughput."""
        return [NodePower(*one) for one in self.throughput.items()]

    @property
    def node_losses(self) -> list[NodeLoss]:
        """The losses with their shares."""
        return [NodeLoss(*one, self.shares[one[0]]) for one in self.losses.items()]

    @property
    def circulating(self) -> float:
        """Power of all loops together [-]; NaN where some power is not determined."""
        return math.nan if self.unknown else math.fsum(loop.power for loop in self.loops)

    @property
    def doubtful(self) -> float:
        """The part of it that may not be in the metal [-]; NaN where it is not determined."""
        if self.unknown:
            return math.nan
        return math.fsum(loop.power for loop in self.loops if loop.shared)

    @property
    def circulating_share(self) -> float:
        """Circulating power relative to all power that enters [-]; NaN where none does."""
        return self.circulating / self.entering if self.entering else math.nan


@told(
    *("gear", "note"),
    input_link_kW="kilowatts",
    by_convention="by_convention",
    ports="ports",
    ideal="ideal",
    lossy="lossy",
)
class GearFlow(NamedTuple):
    """The power of a gear."""

    gear: str
    ideal: PowerFlow | None
    """Without losses; None where speeds or torques contradict each other."""
    lossy: PowerFlow | None
    """With losses; None where `ideal` is, or where friction locks the gear."""
    ports: Flat[PortTable]
    """Speed, torque and power where power enters and leaves."""
    status: Status
    """Why a flow does not exist; `OK` where it does."""
    by_convention: tuple[Node, ...] = ()
    """What turns as one piece and has a part of the power by convention: statics decides
    what enters the piece and leaves it, not how it divides inside."""

    def __repr__(self) -> str:
        """Of which gear, what enters and leaves; not all powers."""
        side = self.shown
        told = f"in {side.entering:.4g}, out {side.leaving:.4g}" if side else self.note
        lost = f", lost {self.lossy.lost:.3g}" if self.lossy else ""
        return f"<GearFlow {self.gear!r}: {told}{lost}>"

    def _repr_html_(self) -> str:
        """Its tables, for a notebook."""
        return in_notebook(higher("flow_grids")([self]))

    @property
    def kilowatts(self) -> float:
        """The power at the input link, of 1 N*m where its load gives none; NaN without [kW]."""
        return self.ports.scales["kW"]

    @property
    def shown(self) -> PowerFlow | None:
        """The flow with losses, if it exists, else the ideal one."""
        return self.lossy or self.ideal

    def divided(self, side: PowerFlow) -> set[tuple[Node, Node]]:
        """Edges of a side whose power is decided by convention: source and target of each.

        Those at devices that divide it so, but for an edge that is the only way between
        what it joins: all power of that part has to pass there.
        """
        edges = [edge[:2] for edge in side.edges]
        devices = {node for node in self.by_convention if node.kind != "link"}
        return edges_on_cycles(edge for edge in edges if not devices.isdisjoint(edge))

    @property
    def note(self) -> str:
        """Why a flow does not exist, else nothing."""
        return self.status.english
