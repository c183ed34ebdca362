"""Texts in the picture of a power flow."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from vstatics.core.flow.circulation import Node
from vstatics.core.flow.power_flow import GearFlow, PowerFlow
from vstatics.pictures.drawing.labels import width, wrapped
from vstatics.pictures.drawing.style import LONG_NAME, SHORT_NAME, Style, number
from vstatics.pictures.drawing.tolerances import LEAST_SHOWN_POWER, SAME_POWER
from vstatics.pictures.drawing.words import fault
from vstatics.pictures.flow.graph import EndPort, Run

LOOP_TEXT_WIDTH = 300.0
"""Width to which the text of a loop is wrapped. [pt]"""
UNBROKEN = "\u00a0"
"""Blank at which a line is not broken."""


class FlowTexts(NamedTuple):
    """Writer of the texts at nodes, bands and loops of a gear."""

    flow: GearFlow
    side: PowerFlow
    style: Style
    short: float = SHORT_NAME
    """Width to which names of runs with a single node are wrapped. [pt]"""

    def power(self, value: float) -> str:
        """Return the text of a relative power, with percent or unit."""
        text = number(value) if value >= LEAST_SHOWN_POWER else "<0.001"
        return text if math.isnan(self.flow.kilowatts) else f"{text}\n{self._kilowatts(value)}"

    def line(self, value: float) -> str:
        """Return the text of a power without line breaks."""
        return self.power(value).replace("\n", ", ")

    def run(
        self,
        run: Run,
        power: float,
        wide: float,
        ports: Sequence[EndPort] = (),
        *,
        back: bool = False,
    ) -> str:
        """Return the names of the nodes of a run with the power, and port powers that differ."""
        names = [_named(node, ports, self.style) for node in run]
        names = [
            name.replace(" ", UNBROKEN) if width(name) <= self.short else name for name in names
        ]
        between = f"{UNBROKEN}{'<' if back else '>'} "
        joined = between.join(reversed(names) if back else names)
        name = wrapped(
            joined, self.short if len(run) == 1 else max(LONG_NAME - SHORT_NAME + self.short, wide)
        ).replace(UNBROKEN, " ")
        lines = [name, "?" if {*run} & {*self.side.unknown} else self.power(power)]
        for port in ports:
            if port.cut is None and not math.isclose(port.power, power, rel_tol=SAME_POWER):
                way = self.style.text("in" if port.enters else "out")
                lines.append(f"{way} {self.power(port.power)}")
        return "\n".join(lines)

    def loop(self, number_of_loop: int) -> str:
        """Return the text of a loop: the power, and a remark on possible artefacts."""
        loop, text = self.side.loops[number_of_loop], self.style.text
        said = f"{text('recirculating power')} {number(loop.power)}"
        if not math.isnan(self.flow.kilowatts):
            said += f", {self._kilowatts(loop.power)}"
        said += f": {self._share(loop.power)}"
        if loop.shared:
            said += f"\n{wrapped(loop.told(text), LOOP_TEXT_WIDTH)}"
        return said

    @property
    def circulating(self) -> str:
        """Text of the total recirculating power of several loops."""
        if len(self.side.loops) < 2 or math.isnan(self.side.circulating):
            return ""
        said = self.style.text("recirculating power in all")
        return f"{said} {self.line(self.side.circulating)}: {self._share(self.side.circulating)}"

    def _share(self, power: float) -> str:
        share = power / self.side.entering if self.side.entering else math.nan
        return f"{100 * share:.1f}% {self.style.text('of the power in')}"

    def _kilowatts(self, power: float) -> str:
        value = power * self.flow.kilowatts
        text = f"{value:.0f}" if value >= 100 else f"{value:#.3g}".removesuffix(".")
        return f"{text} {self.style.text('kW')}"


def port_name(node: Node, style: Style) -> str:
    """Return the name of the input or output. Other ports have the names of their links."""
    ports = {"input": style.text("input"), "output": style.text("output")}
    return ports.get(node.name, node.name)


def _named(node: Node, ports: Sequence[EndPort], style: Style) -> str:
    """Return the name of a node, followed by the name of the port if the names differ."""
    port_nodes = [
        port.node for port in ports if port.node.number == node.number and node.kind == "link"
    ]
    said = [port_name(port, style) for port in port_nodes if port.name != node.name]
    return ": ".join((*said, node.name))


def heading(flow: GearFlow, wide: float, style: Style) -> str:
    """Return the remarks on a gear, which are written above the picture."""
    lines = [fault(flow.status, style)] if flow.note else []
    side = flow.shown
    if side is None:
        lines.append(style.text("no flow of power"))
        return wrapped(": ".join(reversed(lines)), wide)
    if flow.lossy is None:
        lines[-1] += style.text("; drawn without losses")
    ports = (
        (style.text("in"), side.entering),
        (style.text("out"), side.leaving),
        (style.text("lost"), side.lost),
    )
    lines.append(" · ".join(f"{name} {number(value)}" for name, value in ports))
    if not side.edges:
        lines.append(style.text("no power is determined"))
    elif side.unknown:
        unknown = ", ".join(dict.fromkeys(port_name(n, style) for n in side.unknown))
        lines.append(f"{style.text('not determined')}: {unknown}")
    lines.append(FlowTexts(flow, side, style).circulating)
    for loop in side.locked_in:
        text = style.text("within a locked-up group, not drawn")
        lines.append(f"{text}: {number(loop.power)}, {' > '.join(n.name for n in loop.nodes)}")
    return "\n".join(wrapped(line, wide) for line in lines if line)
