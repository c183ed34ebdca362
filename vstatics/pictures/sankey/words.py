"""What is written in a picture of power."""

from __future__ import annotations

import math

from vstatics.flow.circulation import Node
from vstatics.flow.power import GearFlow, PowerFlow
from vstatics.pictures.labels import wrapped
from vstatics.pictures.sankey.columns import Words
from vstatics.pictures.style import Style, number

LONGEST = 84.0
"""Names are wrapped to this width. [pt]"""
LEAST = 0.0005
"""What is less is not 0.000."""


def words(flow: GearFlow, side: PowerFlow, style: Style) -> Words:
    """What is written in the picture of a gear."""
    unknown = set(side.unknown)

    def power(value: float) -> str:
        told = number(value) if value >= LEAST else "<0.001"
        load = "" if math.isnan(flow.kilowatts) else f"\n{_kilowatts(flow, value, style)}"
        return told + load

    def node(one: Node, value: float) -> str:
        return f"{wrapped(_name(one, style), LONGEST)}\n{'?' if one in unknown else power(value)}"

    def loop(value: float) -> str:
        told = style.text("circulates", "циркулирует")
        share = value / side.entering if side.entering else math.nan
        of = style.text("of the power in", "входящей мощности")
        load = "" if math.isnan(flow.kilowatts) else f", {_kilowatts(flow, value, style)}"
        return f"{told} {number(value)}{load}: {100 * share:.1f}% {of}"

    return Words(node, power, loop)


def _kilowatts(flow: GearFlow, power: float, style: Style) -> str:
    """A power to three digits."""
    value = power * flow.kilowatts
    told = f"{value:.0f}" if value >= 100 else f"{value:#.3g}".removesuffix(".")
    return f"{told} {style.text('kW', 'кВт')}"


def _name(node: Node, style: Style) -> str:
    """The name of a node; ports have no names of the case."""
    words = {"input": style.text("input", "вход"), "output": style.text("output", "выход")}
    return words.get(node.name, node.name) if node.kind == "port" else node.name


def heading(flow: GearFlow, wide: float, style: Style) -> str:
    """What is to be said of a gear besides its picture."""
    notes = {
        "freewheels in conflict": "конфликт обгонных муфт",
        "tied up": "заперта",
        "torques do not balance": "моменты не уравновешены",
        "locked by friction": "заклинена трением",
        "signs of losses not found": "знаки потерь не найдены",
    }
    lines = [style.text(flow.note, notes.get(flow.note, flow.note))] if flow.note else []
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
    for loop in side.locked_in:
        told = style.text("within one piece, not drawn", "внутри одного целого, не показано")
        lines.append(f"{told}: {number(loop.power)}, {' > '.join(n.name for n in loop.nodes)}")
    return "\n".join(wrapped(line, wide) for line in lines)
