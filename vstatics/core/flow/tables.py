"""Power flow of a gear as a table with remarks, for all formats for people."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from functools import partial
from itertools import zip_longest

from vstatics.core.flow.circulation import Loop, Node, NodeKind
from vstatics.core.flow.power_flow import GearFlow, PowerFlow
from vstatics.core.tables.grid import Cell, Column, Grid, Row, exact, text, word
from vstatics.core.tables.numbers import fixed
from vstatics.core.texts import tr

SECTIONS: Mapping[NodeKind, str] = {
    "link": "links",
    "mechanism": "mechanisms",
    "spring": "springs",
    "element": "shift elements",
    "drag": "drag of links",
    "gear": "loss of the gear as a whole",
}
"""Section heading for each kind of node."""
NO_LOSSES = (None, None)
_Line = tuple[int, Row]
"""Indentation level of a table row, and its cells."""
CONVENTION = "~"
"""Mark of power whose split within a block is a convention."""


def power_grid(flow: GearFlow) -> Grid:
    """Return a table of the power through links, mechanisms, springs and shift elements.

    If the gear has a load, there are columns in kW. Below a mechanism are rows for its members and
    its teeth, and below a spring with more than two links, for its members. Nodes without power are
    omitted. Without a flow the table is empty. The last column marks powers that are a convention.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> from vstatics.core.flow.power import flows
    >>> pair = Mechanism(1, 2, 0, -4.0, 0.98, name="pair")
    >>> [flow] = flows(solve(Transmission(2, [], [pair], [Gear()])))
    >>> power_grid(flow).texts[4]
    ['pair', '1.000', '1.000', '0.02000', '100.0']
    """
    load = not math.isnan(flow.kilowatts)
    columns = [text("power through"), Column("ideal"), Column("with losses")]
    columns += [Column("kW")] * load + [Column("loss")] + [Column("loss, kW")] * load
    columns += [Column("share, %"), *[text("by convention")] * bool(flow.by_convention)]
    lines: list[_Line] = []
    moving = [node for node, carries in _nodes(flow).items() if carries]
    for kind, heading in SECTIONS.items():
        nodes = [node for node in moving if node.kind == kind]
        if nodes:
            lines.append((1, [word(heading), *[""] * (len(columns) - 1)]))
        for node in nodes:
            lines.append((2, _of_node(flow, node)))
            if kind in ("mechanism", "spring"):
                below = [*_of_members(flow, node), *_of_teeth(flow, node)]
                # the power at both links of a shaft is equal
                if kind == "spring" and len(below) < 3:
                    below = []
                lines += below
    rows, levels = [row for _, row in lines], [level for level, _ in lines]
    return Grid(tr("Gear {gear}", gear=flow.gear), columns, rows, levels)


def remarks(flow: GearFlow, digits: int | None = None, *, balanced: bool = True) -> Iterator[str]:
    """Yield remarks: nodes without power, the balance, and loops of recirculating power.

    Parameters
    ----------
    digits : int, optional
        Number of decimals. Default: 3.
    balanced : bool
        True to include the balance of powers.
    """
    if flow.ideal is None:
        return
    shown_as = partial(fixed, decimals=3 if digits is None else digits)
    nodes = _nodes(flow).items()
    still = [str(node) for node, carries in nodes if not carries and node.kind in SECTIONS]
    if still:
        yield tr("no power: {names}", names=", ".join(still))
    if flow.by_convention:
        names = ", ".join(map(str, flow.by_convention))
        yield f"{CONVENTION} {tr('by convention, as it is locked up: {names}', names=names)}"
    if flow.note:
        yield tr("with losses: {note}", note=tr(flow.note))
    shown = flow.lossy or flow.ideal
    if balanced:
        entering, leaving, lost = map(shown_as, (shown.entering, shown.leaving, shown.lost))
        balance = tr(
            "in {entering} - out {leaving} - lost {lost} = {balance}",
            entering=entering,
            leaving=leaving,
            lost=lost,
            balance=shown_as(shown.balance),
        )
        without = tr("; 1 is the power of 1 N*m at the input, as its torque is 0")
        yield balance + without * (not flow.ports.input_torque)
    unknown = [str(node) for node in shown.unknown]
    if unknown:
        yield f"{tr('not determined')}: {', '.join(unknown)}"
        yield tr("recirculating power: not determined")
        return
    if flow.ideal.loops or shown.loops:
        yield _circulating(flow.ideal, shown, shown_as)
    else:
        yield tr("recirculating power: none")
    for loop in shown.loops:
        note = f" ({loop.told(tr)})" if loop.shared else ""
        yield f"  {shown_as(loop.power)}{note}: {around(loop)}"
    for loop in shown.locked_in:
        within = tr("within a locked-up group, not counted")
        yield f"{within}: {shown_as(loop.power)}: {around(loop)}"


def around(loop: Loop) -> str:
    """Return words for the nodes of a loop, with the first node again at the end."""
    return " > ".join(map(str, (*loop.nodes, loop.nodes[0])))


def _circulating(ideal: PowerFlow, shown: PowerFlow, shown_as: Callable[[float], str]) -> str:
    share = shown.circulating_share
    circulating = tr("recirculating power: {power}", power=shown_as(shown.circulating))
    if not math.isnan(share):
        circulating += f", {100 * share:.1f}% {tr('of the power in')}"
    if shown is not ideal:
        circulating += tr("; ideal {power}", power=shown_as(ideal.circulating))
    return "; ".join(filter(None, (circulating, doubt(shown, shown_as))))


def doubt(side: PowerFlow, shown_as: Callable[[float], str]) -> str:
    """Return words for recirculating power that can be an artefact of the model; else ""."""
    if not side.doubtful > 0:
        return ""
    return tr("{power} of it may be an artefact of the model", power=shown_as(side.doubtful))


def _nodes(flow: GearFlow) -> dict[Node, bool]:
    """Return all nodes of both flows, and whether each node has or can have power."""
    carrying: dict[Node, bool] = {}
    for side in (flow.ideal, flow.lossy):
        for node, power in side.throughput.items() if side is not None else ():
            carrying[node] = carrying.get(node, False) or power != 0
    return carrying


def _of_node(flow: GearFlow, node: Node) -> Row:
    ideal, lossy = (
        math.nan if side is None else side.throughput.get(node, 0.0)
        for side in (flow.ideal, flow.lossy)
    )
    mark = CONVENTION if node in flow.by_convention else ""
    losses = (flow.lossy.losses.get(node), flow.lossy.shares.get(node)) if flow.lossy else NO_LOSSES
    return _row(flow, str(node), (ideal, lossy), losses, mark=mark)


def _of_members(flow: GearFlow, node: Node) -> Iterator[_Line]:
    assert flow.ideal is not None  # noqa: S101 - for mypy
    lossy = {} if flow.lossy is None else _by_member(flow.lossy, node)
    for (member, link), power in _by_member(flow.ideal, node).items():
        if link != "housing":
            powers = power, lossy.get((member, link), math.nan)
            label = f"{member}: {link}"
            yield 3, _row(flow, link if node.kind == "spring" else word(label), powers)


def _of_teeth(flow: GearFlow, node: Node) -> Iterator[_Line]:
    """Yield rows with the rolling power of a mechanism, and of each mesh with its loss."""
    assert flow.ideal is not None  # noqa: S101 - for mypy
    ideal = [tooth_power for tooth_power in flow.ideal.teeth if tooth_power.device == node]
    lossy = (
        [tooth_power for tooth_power in flow.lossy.teeth if tooth_power.device == node]
        if flow.lossy
        else []
    )
    for tooth_power, with_losses in zip_longest(ideal, lossy):
        power = math.nan if with_losses is None else with_losses.power
        if not tooth_power.mesh:
            yield 3, _row(flow, word("teeth"), (tooth_power.power, power))
        elif flow.lossy is None:
            yield 4, _row(flow, tooth_power.mesh, (tooth_power.power, power))
        else:
            share = with_losses.loss / flow.lossy.lost if flow.lossy.lost else math.nan
            yield (
                4,
                _row(flow, tooth_power.mesh, (tooth_power.power, power), (with_losses.loss, share)),
            )


def _by_member(side: PowerFlow, node: Node) -> dict[tuple[str, str], float]:
    return {
        (member_power.member, member_power.link): member_power.power
        for member_power in side.members
        if member_power.device == node
    }


def _row(
    flow: GearFlow,
    name: Cell | str,
    powers: tuple[float, float],
    losses: tuple[float | None, float | None] = NO_LOSSES,
    *,
    mark: str = "",
) -> Row:
    """Return a row: powers without and with losses, loss, and fraction of all losses."""
    (ideal, lossy), (loss, share), unit = powers, losses, flow.kilowatts
    load = not math.isnan(unit)
    return [
        name,
        exact(ideal),
        exact(lossy),
        *[exact(lossy * unit)] * load,
        "" if loss is None else exact(loss, 4),
        *["" if loss is None else exact(loss * unit)] * load,
        "" if share is None or math.isnan(share) else exact(100 * share, 1),
        *[mark] * bool(flow.by_convention),
    ]
