"""Line of text for a gear without branches: its nodes in series, each with its loss."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain
from typing import NamedTuple

from vstatics.core.flow.circulation import Node
from vstatics.core.flow.power_flow import GearFlow
from vstatics.core.groups import filled
from vstatics.pictures.drawing.labels import height, width
from vstatics.pictures.drawing.pen import Pen
from vstatics.pictures.flow.graph import Graph
from vstatics.pictures.flow.titles import FlowTitles

BETWEEN_NODES = ">"
_MINUS = "\N{MINUS SIGN}"
WORD_GAP = 4.0
"""Distance between words, which are separate texts because SVG drops blanks at the ends. [pt]"""


def is_chain(flow: GearFlow, drawn: Graph) -> bool:
    """Return whether the power flow of a gear is a single straight row without remarks.

    The row begins where power enters and ends where power leaves. A component behind the output,
    such as a dragging brake, is a branch.
    """
    side = flow.shown
    if side is None or flow.note or side.unknown or side.loops or side.locked_in:
        return False
    nodes = _in_line(drawn)
    ports = [
        (node, port.enters) for node, ports_of_node in drawn.ports.items() for port in ports_of_node
    ]
    alone = len({*drawn.layers}) == len(drawn.runs) == 1 + max(drawn.layers)
    steps = {drawn.ends(band) for band in drawn.bands if not drawn.is_within(band)}
    return (
        alone
        and len(steps) == len(drawn.runs) - 1
        and sorted(ports, key=lambda end: not end[1]) == [(nodes[0], True), (nodes[-1], False)]
    )


def _in_line(drawn: Graph) -> list[Node]:
    order = sorted(range(len(drawn.runs)), key=lambda place: drawn.layers[place])
    return [node for place in order for node in drawn.runs[place]]


class ChainWord(NamedTuple):
    """Word in the line of text of a gear."""

    text: str
    title: str = ""
    is_loss: bool = False

    @property
    def wide(self) -> float:
        """Width of the word with the following gap [pt]."""
        return width(self.text) + WORD_GAP


class ChainLine(NamedTuple):
    """Line of text of a gear, broken to a given width."""

    lines: Sequence[Sequence[ChainWord]]

    @property
    def high(self) -> float:
        """Height of the lines [pt]."""
        return height("") * len(self.lines)

    def draw(self, pen: Pen, left: float, top: float) -> None:
        """Draw the lines with a given upper left corner [pt]."""
        for line in self.lines:
            x = left
            for word in line:
                colour = pen.style.lost if word.is_loss else pen.style.ink
                pen.text(x, top, word.text, va="top", color=colour, title=word.title)
                x += word.wide
            top -= height("")


def chain_line(drawn: Graph, said: FlowTitles, room: float) -> ChainLine:
    """Return the line of text of a gear, broken to a width [pt]."""
    lines = filled(_words(drawn, said), room, lambda group: sum(word.wide for word in group))
    return ChainLine([[*chain.from_iterable(groups)] for groups in lines])


def _words(drawn: Graph, said: FlowTitles) -> list[list[ChainWord]]:
    """Return groups of words to keep together: a node, the loss of the node and the next symbol."""
    texts = said.texts
    nodes = _in_line(drawn)
    groups = [[ChainWord(texts.line(texts.side.entering))]]
    for node in nodes:
        loss = drawn.losses.get(node, 0.0)
        title = said.node(node, drawn.through(node), loss)
        words = [ChainWord(_name(node, drawn), title)]
        if loss:
            words.append(ChainWord(f"{_MINUS}{texts.line(loss)}", title, is_loss=True))
        if node != nodes[-1]:
            words.append(ChainWord(BETWEEN_NODES))
        groups.append(words)
    return [*groups, [ChainWord(texts.line(texts.side.leaving))]]


def _name(node: Node, drawn: Graph) -> str:
    names = [port.node.name for port in drawn.ports.get(node, ())]
    more = [name for name in names if name not in (node.name, "input", "output")]
    return ": ".join([*more, node.name])
