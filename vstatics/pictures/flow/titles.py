"""Tooltips of the nodes and bands of a power flow."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import NamedTuple

from vstatics.core.flow.circulation import Node
from vstatics.core.numerics.traced import plain
from vstatics.core.statics.state import GearState
from vstatics.pictures.drawing.words import quantity, word
from vstatics.pictures.flow.graph import Band, EndPort
from vstatics.pictures.flow.texts import FlowTexts, port_name


class FlowTitles(NamedTuple):
    """Writer of the tooltips of a gear: power, torque and speed, relative to the input."""

    texts: FlowTexts
    speeds: Mapping[str, float]
    """Speed of each link, by name, relative to the input. [-]"""
    torques: Mapping[tuple[Node, str], float]
    """Torque of links on the members of mechanisms, with losses if known, relative to the input.
    [-]
    """
    divided: frozenset[tuple[Node, Node]]
    """Pairs of neighbouring nodes between which power is divided by convention."""

    def is_divided(self, band: Band) -> bool:
        """Return whether power is divided by convention everywhere along a band."""
        return self.divided.issuperset(band.pairs)

    def is_open(self, node: Node) -> bool:
        """Return whether a node rotates as a block, so that convention divides the power."""
        return node in self.texts.flow.by_convention

    def is_mild(self, node: Node) -> bool:
        """Return whether convention affects only the friction in a block, not the power around it.

        For example, a locked-up differential divides torque by its ratio, and convention decides
        only the small friction in its teeth.
        """
        return self.is_open(node) and not any(node in pair for pair in self.divided)

    def is_doubtful(self, band: Band) -> bool:
        """Return whether a band belongs to a loop that can be an artefact of the model."""
        return band.loop is not None and bool(self.texts.side.loops[band.loop].shared)

    def band(self, band: Band) -> str:
        """Return the tooltip of a band.

        Torque and speed are left out if the band passes further nodes, where they change.
        """
        nodes = band.source, *band.between, band.target
        names = " → ".join(map(str, nodes))
        link = next(node for node in nodes if node.kind == "link")
        said = [self._power(band.power)]
        if len(nodes) == 2:
            said += self._turning(band.power, link.name)
        if band.loop is not None:
            said.append(self.texts.style.text("recirculating power"))
        if self.is_doubtful(band):
            said.append(self.texts.style.text("may be an artefact of the model"))
        said += [self._convention] * self.is_divided(band)
        return f"{names}: {', '.join(said)}"

    def port(self, link: Node, port: EndPort) -> str:
        """Return the tooltip of a port, or of a cut band."""
        if port.cut is not None:
            return self.band(port.cut)
        said = [self._power(port.power), *self._turning(port.power, link.name)]
        return f"{port_name(port.node, self.texts.style)}: {', '.join(said)}"

    def node(self, node: Node, power: float, lost: float) -> str:
        """Return the tooltip of a node: the transmitted power, the loss and the members."""
        said = [self._power(power)]
        if node.kind == "link":
            said += self._turning(power, node.name)
        if lost:
            said.append(f"{self.texts.style.text('lost')} {self.texts.line(lost)}")
        if self.is_open(node):
            said.append(
                self.texts.style.text("within friction") if self.is_mild(node) else self._convention
            )
        return "\n".join([f"{node}: {', '.join(said)}", *self._members(node)])

    def _members(self, node: Node) -> Iterator[str]:
        for device, member, link, power in self.texts.side.members:
            if device == node:
                speed = self.speeds.get(link, 0.0)
                torque = self.torques.get((device, member), power / speed if speed else 0.0)
                is_plain = member in ("first", "second", link)
                name = link if is_plain else f"{word(member, self.texts.style)} ({link})"
                yield f"{name}: {', '.join(self._torque(torque, speed))}"

    def _power(self, power: float) -> str:
        return f"{self.texts.style.text('power')} {self.texts.line(power)}"

    def _turning(self, power: float, link: str) -> list[str]:
        speed = self.speeds[link]
        return self._torque(power / abs(speed), speed) if speed else []

    def _torque(self, torque: float, speed: float) -> list[str]:
        style = self.texts.style
        return [quantity("torque", torque, style), quantity("speed", speed, style)]

    @property
    def _convention(self) -> str:
        return self.texts.style.text("by convention")


def titles(texts: FlowTexts, state: GearState) -> FlowTitles:
    """Return the writer of the tooltips of a gear."""
    case, lossy = state.case, texts.side is texts.flow.lossy
    torques = {
        (Node("mechanism", number, device.name), member): plain(torque)
        for number, (device, members) in enumerate(
            zip(case.own_devices, state.member_torques(lossy=lossy), strict=True), 1
        )
        for member, torque in members.items()
    }
    speeds = {
        case.link_name(link): plain(state.speeds[link - 1]) for link in range(1, case.own_links + 1)
    }
    return FlowTitles(texts, speeds, torques, frozenset(texts.flow.divided(texts.side)))
