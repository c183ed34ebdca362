"""What is written in the picture `flow`."""

from __future__ import annotations

import math
from typing import NamedTuple

from vstatics.flow.circulation import Node
from vstatics.flow.grids import CONVENTION
from vstatics.flow.power_flow import GearFlow, PowerFlow
from vstatics.flow.shared_planets import words
from vstatics.pictures.labels import wrapped
from vstatics.pictures.style import Style, number
from vstatics.pictures.words import fault

LONGEST = 84.0
"""Names are wrapped to this width. [pt]"""
WIDEST = 300.0
"""What is said of a loop is wrapped to this width. [pt]"""
LEAST = 0.0005
"""What is less is not 0.000."""


class FlowTexts(NamedTuple):
    """What is written at the nodes, bands and loops of a gear; a text may have lines."""

    flow: GearFlow
    side: PowerFlow
    style: Style

    def power(self, value: float) -> str:
        """Of a loss, and of a band."""
        text = number(value) if value >= LEAST else "<0.001"
        return text if math.isnan(self.flow.kilowatts) else f"{text}\n{self._kilowatts(value)}"

    def node(self, node: Node, power: float) -> str:
        """The name of a node, and the power through it."""
        mark = f" {CONVENTION}" if node in self.flow.by_convention else ""
        name = wrapped(_name(node, self.style) + mark, LONGEST)
        return f"{name}\n{'?' if node in self.side.unknown else self.power(power)}"

    def loop(self, number_of_loop: int) -> str:
        """Power that circulates, and why it may not, by the index of the loop."""
        power, doubt = self.side.loops[number_of_loop].power, self._doubt(number_of_loop)
        text = f"{self.style.text('circulates', 'циркулирует')} {number(power)}"
        if not math.isnan(self.flow.kilowatts):
            text += f", {self._kilowatts(power)}"
        share = power / self.side.entering if self.side.entering else math.nan
        of = self.style.text("of the power in", "входящей мощности")
        return f"{text}: {100 * share:.1f}% {of}{doubt}"

    def _doubt(self, number_of_loop: int) -> str:
        """Further lines of a loop that may not be in the metal."""
        found = self.side.loops[number_of_loop].shared
        if not found:
            return ""
        said = [f"у {one.first} и {one.second} общие {' и '.join(one.links)}" for one in found]
        russian = f"в металле может не быть: {', '.join(said)}"
        return f"\n{wrapped(self.style.text(words(found), russian), WIDEST)}"

    def _kilowatts(self, power: float) -> str:
        """A power to three digits."""
        value = power * self.flow.kilowatts
        text = f"{value:.0f}" if value >= 100 else f"{value:#.3g}".removesuffix(".")
        return f"{text} {self.style.text('kW', 'кВт')}"


def _name(node: Node, style: Style) -> str:
    """The name of a node; ports have no names of the case."""
    ports = {"input": style.text("input", "вход"), "output": style.text("output", "выход")}
    return ports.get(node.name, node.name) if node.kind == "port" else node.name


def heading(flow: GearFlow, wide: float, style: Style) -> str:
    """What is to be said of a gear besides its picture."""
    lines = [fault(flow.status, style)] if flow.note else []
    side = flow.lossy or flow.ideal
    if side is None:
        lines.append(style.text("no flow of power", "потока мощности нет"))
        return wrapped(": ".join(reversed(lines)), wide)
    if flow.lossy is None:
        lines[-1] += style.text("; drawn without losses", "; показана без потерь")
    ports = (
        (style.text("in", "вход"), side.entering),
        (style.text("out", "выход"), side.leaving),
        (style.text("lost", "потери"), side.lost),
    )
    lines.append(" · ".join(f"{name} {number(value)}" for name, value in ports))
    if not side.edges:
        lines.append(style.text("no power is determined", "мощности не определены"))
    elif side.unknown:
        unknown = ", ".join(_name(node, style) for node in side.unknown)
        lines.append(f"{style.text('not determined', 'не определены')}: {unknown}")
    if flow.by_convention:
        text = style.text(
            "by convention, as it turns as one piece", "условно: внутри одного целого"
        )
        names = ", ".join(_name(node, style) for node in flow.by_convention)
        lines.append(f"{CONVENTION} {text}: {names}")
    for loop in side.locked_in:
        text = style.text("within one piece, not drawn", "внутри одного целого, не показано")
        lines.append(f"{text}: {number(loop.power)}, {' > '.join(n.name for n in loop.nodes)}")
    return "\n".join(wrapped(line, wide) for line in lines)
