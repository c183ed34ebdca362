"""The power of gears as text for people, and as JSON."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

from vstatics.flow.circulation import Loop, Node, NodeKind
from vstatics.flow.power import GearFlow, PowerFlow
from vstatics.tables.numbers import fixed

WIDTH = 79
NAME = 27
"""Columns of a name; a longer one has a line of its own."""
SECTIONS: Mapping[NodeKind, str] = {
    "link": "links",
    "mechanism": "mechanisms",
    "element": "shift elements",
    "drag": "drag of links",
}
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


class Row(NamedTuple):
    """A line of the table; None leaves a field empty."""

    name: str
    """Of a link, a mechanism, a member..."""
    ideal: float | None = None
    lossy: float | None = None
    loss: float | None = None
    share: float | None = None


def text(flow: GearFlow) -> str:
    """The power of a gear as a table of 79 columns.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> from vstatics.flow.power import flows
    >>> pair = Mechanism(1, 2, 0, -4.0, 0.98, name="pair")
    >>> [flow] = flows(solve(Transmission(2, [], [pair], [Gear()])))
    >>> print(text(flow), end="")
    gear 1                         ideal    lossy     loss  share
    links
      1                            1.000    1.000
      2                            1.000     .980
    mechanisms
      pair                         1.000    1.000    .0200 100.0%
        first: 1                   1.000    1.000
        second: 2                 -1.000    -.980
    in 1.000 - out .980 - lost .020 = .000
    circulating: none
    """
    return "".join(f"{line.rstrip()}\n" for line in _lines(flow))


def _lines(flow: GearFlow) -> Iterator[str]:
    if flow.ideal is None:
        yield f"gear {flow.gear}: {flow.note}, so there is no power to show"
        return
    unit = flow.kilowatts
    yield from _numbered(f"gear {flow.gear}", _heading(unit))
    for heading, rows in sections(flow):
        yield heading
        for row, level in rows:
            yield from _row(row, unit, indent=2 * level)
    for remark in remarks(flow):
        yield from _wrapped(remark, 4 if remark.startswith(" ") else 2)


def sections(flow: GearFlow) -> Iterator[tuple[str, list[tuple[Row, int]]]]:
    """The parts of a gear's table: a heading, rows with their levels from 1.

    Whatever has no power is left out. There are none where the ideal flow does not exist.
    """
    moving = [node for node in _nodes(flow) if _carries(flow, node)]
    for kind, heading in SECTIONS.items():
        rows: list[tuple[Row, int]] = []
        for node in moving:
            if node.kind != kind:
                continue
            rows.append((_of_node(flow, node), 1))
            if kind == "mechanism":
                rows += [(row, 2) for row in _of_members(flow, node)]
        if rows:
            yield heading, rows


def remarks(flow: GearFlow) -> Iterator[str]:
    """What is without power, the balance, what circulates: a line each, loops set in."""
    if flow.ideal is None:
        return
    still = [str(n) for n in _nodes(flow) if not _carries(flow, n) and n.kind in SECTIONS]
    if still:
        yield f"no power: {', '.join(still)}"
    if flow.note:
        yield f"with losses: {flow.note}"
    shown = flow.lossy or flow.ideal
    given = (shown.entering, shown.leaving, shown.lost, shown.balance)
    entering, leaving, lost, rest = map(fixed, given)
    yield f"in {entering} - out {leaving} - lost {lost} = {rest}"
    unknown = [str(node) for node in shown.unknown]
    if unknown:
        yield f"not determined: {', '.join(unknown)}"
        yield "circulating: not determined"
        return
    if flow.ideal.loops or shown.loops:
        yield _circulating(flow.ideal, flow.lossy)
    else:
        yield "circulating: none"
    for loop in shown.loops:
        yield f"  {fixed(loop.power)}: {around(loop)}"
    for loop in shown.locked_in:
        yield f"within one piece, does not count: {fixed(loop.power)}: {around(loop)}"


def around(loop: Loop) -> str:
    """A loop in words: its nodes, and the first again."""
    return " > ".join(map(str, (*loop.nodes, loop.nodes[0])))


def _circulating(ideal: PowerFlow, lossy: PowerFlow | None) -> str:
    shown = lossy or ideal
    share = shown.circulating_share
    of_input = "" if math.isnan(share) else f", {100 * share:.1f}% of the power in"
    without = "" if lossy is None else f"; ideal {fixed(ideal.circulating)}"
    return f"circulating: {fixed(shown.circulating)}{of_input}{without}"


def _nodes(flow: GearFlow) -> list[Node]:
    """All nodes of both flows."""
    sides = [side.throughput for side in (flow.ideal, flow.lossy) if side is not None]
    return list(dict.fromkeys(node for side in sides for node in side))


def _carries(flow: GearFlow, node: Node) -> bool:
    """Whether power goes through, or may."""
    sides = [side for side in (flow.ideal, flow.lossy) if side is not None]
    return any(side.throughput.get(node, 0.0) != 0 for side in sides)


def _of_node(flow: GearFlow, node: Node) -> Row:
    ideal, lossy = flow.ideal, flow.lossy
    entering = ideal.throughput.get(node, 0.0) if ideal is not None else math.nan
    if lossy is None:
        return Row(str(node), entering, math.nan)
    passing = lossy.throughput.get(node, 0.0)
    return Row(str(node), entering, passing, lossy.losses.get(node), lossy.shares.get(node))


def _of_members(flow: GearFlow, node: Node) -> Iterator[Row]:
    """Power of each member of a mechanism, but those that are the housing."""
    assert flow.ideal is not None  # noqa: S101 - for mypy
    lossy = {} if flow.lossy is None else _by_member(flow.lossy, node)
    for (member, link), power in _by_member(flow.ideal, node).items():
        if link != "housing":
            yield Row(f"{member}: {link}", power, lossy.get((member, link), math.nan))


def _by_member(side: PowerFlow, node: Node) -> dict[tuple[str, str], float]:
    return {(one.member, one.link): one.power for one in side.members if one.device == node}


def _row(row: Row, unit: float, indent: int) -> Iterator[str]:
    """A row of the table; with a load powers are in kW, too."""
    fields = [_field(row.ideal, 3), _field(row.lossy, 3)]
    if not math.isnan(unit):
        fields.append(_field(None if row.lossy is None else row.lossy * unit, 2))
    fields.append(_field(row.loss, 4))
    if not math.isnan(unit):
        fields.append(_field(None if row.loss is None else row.loss * unit, 2))
    known = row.share is not None and not math.isnan(row.share)
    fields.append(f"{100 * (row.share or 0.0):6.1f}%" if known else "")
    yield from _numbered(" " * indent + row.name, "".join(fields))


def _field(value: float | None, decimals: int) -> str:
    return " " * 9 if value is None else " " + fixed(value, 8, decimals)


def _heading(unit: float) -> str:
    """Headings of the columns."""
    loads = [] if math.isnan(unit) else ["kW"]
    heads = ["ideal", "lossy", *loads, "loss", *loads]
    return "".join(f"{head:>9}" for head in heads) + f"{'share':>7}"


def _numbered(name: str, numbers: str) -> list[str]:
    """A name and its numbers, on two lines where the name is long."""
    if len(name) > NAME:
        return [name, " " * NAME + numbers]
    return [name.ljust(NAME) + numbers]


def _wrapped(line: str, indent: int) -> list[str]:
    return textwrap.wrap(
        line, WIDTH, subsequent_indent=" " * indent, break_long_words=False, break_on_hyphens=False
    )


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
