"""A gear in which nothing branches: its nodes as one line of text, with what each loses."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from vstatics.core.flow.circulation import Node
from vstatics.core.flow.power_flow import GearFlow
from vstatics.pictures.drawing.labels import height, width
from vstatics.pictures.drawing.pen import Pen
from vstatics.pictures.drawing.style import SIZE
from vstatics.pictures.flow.graph import Graph
from vstatics.pictures.flow.texts import FlowTexts
from vstatics.pictures.flow.titles import FlowTitles

BETWEEN_NODES = ">"
_MINUS = "\N{MINUS SIGN}"
WORD_GAP = 4.0
"""Between pieces of a line: blanks at ends of texts are lost in SVG. [pt]"""


def is_chain(flow: GearFlow, drawn: Graph) -> bool:
    """Whether the picture of a gear would be one straight row, of which nothing is to be said.

    It begins where power enters and ends where it leaves: what goes on behind the output, to a
    brake that drags, is a branch.
    """
    side = flow.shown
    if side is None or flow.note or side.unknown or side.loops or side.locked_in:
        return False
    nodes = _in_line(drawn)
    ports = [(node, port.enters) for node, own in drawn.ports.items() for port in own]
    alone = len({*drawn.layers}) == len(drawn.runs) == 1 + max(drawn.layers)
    steps = {drawn.ends(band) for band in drawn.bands if not drawn.is_within(band)}
    return (
        alone
        and len(steps) == len(drawn.runs) - 1
        and sorted(ports, key=lambda one: not one[1]) == [(nodes[0], True), (nodes[-1], False)]
    )


def _in_line(drawn: Graph) -> list[Node]:
    """All nodes of runs from left to right."""
    order = sorted(range(len(drawn.runs)), key=lambda place: drawn.layers[place])
    return [node for place in order for node in drawn.runs[place]]


class ChainWord(NamedTuple):
    """A piece of the line of a gear."""

    text: str
    title: str = ""
    is_loss: bool = False

    @property
    def wide(self) -> float:
        """With the gap behind it [pt]."""
        return width(self.text) + WORD_GAP


class ChainLine(NamedTuple):
    """The words of a gear in lines of a width."""

    lines: Sequence[Sequence[ChainWord]]

    @property
    def high(self) -> float:
        """[pt]."""
        return height("", SIZE) * len(self.lines)

    def draw(self, pen: Pen, left: float, top: float) -> None:
        """From an upper left corner on [pt]."""
        for line in self.lines:
            x = left
            for one in line:
                colour = pen.style.lost if one.is_loss else pen.style.ink
                pen.text(x, top, one.text, va="top", color=colour, title=one.title)
                x += one.wide
            top -= height("", SIZE)


def chain_line(drawn: Graph, said: FlowTitles, room: float) -> ChainLine:
    """The line of a gear in a width [pt]."""
    lines: list[list[ChainWord]] = [[]]
    taken = 0.0
    for own in _words(drawn, said):
        wide = sum(one.wide for one in own)
        if taken and taken + wide > room:
            lines.append([])
            taken = 0.0
        lines[-1] += own
        taken += wide
    return ChainLine(lines)


def _words(drawn: Graph, said: FlowTitles) -> list[list[ChainWord]]:
    """What stays together: a node with its loss and the sign of what follows."""
    texts = said.texts
    nodes = _in_line(drawn)
    entering, leaving = texts.side.entering, texts.side.leaving
    found = [[ChainWord(_one_line(texts, entering))]]
    for node in nodes:
        loss = drawn.losses.get(node, 0.0)
        told = said.node(node, drawn.through(node), loss)
        words = [ChainWord(_name(node, drawn), told)]
        if loss:
            words.append(ChainWord(f"{_MINUS}{_one_line(texts, loss)}", told, is_loss=True))
        if node != nodes[-1]:
            words.append(ChainWord(BETWEEN_NODES))
        found.append(words)
    return [*found, [ChainWord(_one_line(texts, leaving))]]


def _one_line(texts: FlowTexts, power: float) -> str:
    return texts.power(power).replace("\n", ", ")


def _name(node: Node, drawn: Graph) -> str:
    """A node, with the name of a port that is neither its own nor that of the input or output."""
    names = [port.node.name for port in drawn.ports.get(node, ())]
    more = [name for name in names if name not in (node.name, "input", "output")]
    return ": ".join([*more, node.name])
