"""Units of what a sweep varies and of its columns, as a dataset tells them."""

from __future__ import annotations

from vstatics.core.model.shape import STRAIGHT, UNIT_OF
from vstatics.core.model.transmission import Transmission
from vstatics.core.readers.expressions.evaluation import LAST
from vstatics.core.readers.expressions.grammar import Applied
from vstatics.core.tables.quantities import BY_NAME, UNITS
from vstatics.sweep.plan import SweepPlan
from vstatics.sweep.results.documents import Subject
from vstatics.sweep.results.expressions import Node
from vstatics.sweep.results.meanings import OMEGA, Selection
from vstatics.sweep.variants.path_numbers import CasePath
from vstatics.sweep.variants.targets import Target, Varied

KEEPING = (LAST, "abs", "min", "max", "sum")
"""Functions whose value is in the unit of what they are of."""


def units_of(plan: SweepPlan) -> dict[str, str]:
    """The units of varied numbers and columns, as far as they have one that is known.

    Examples
    --------
    >>> from vstatics import Gear, Load, Mechanism, Transmission, sweep
    >>> case = Transmission(2, [], [Mechanism(1, 2, 0, -2.5)], [Gear()], load=Load(2000, 300))
    >>> grid = {"load.torque": [200, 400], "D1.ratio": [-2, -3]}
    >>> units_of(sweep(case, grid, out="ratio[1], speeds_rpm[2,1], 2*speeds_rpm[2,1]").plan)
    {'load.torque': 'N*m', 'speeds_rpm[2,1]': 'rpm'}
    """
    subject = plan.subject
    case = subject if isinstance(subject, Transmission) else subject.base_case
    found = {one.name: _of_varied(one, case) for one in plan.variants.targets}
    each = (part.expression.node for part in plan.columns.parts for _ in part.cells)
    units = (_of_node(node, subject) for node in each)
    found |= zip(plan.headings, units, strict=True)
    return {name: unit for name, unit in found.items() if unit}


def _of_varied(one: Varied, case: Transmission) -> str:
    if isinstance(one, CasePath):
        if one.unit or one.measure is None:
            return one.unit
        return "W" if one.measure == "power" else UNIT_OF[one.measure]
    if not isinstance(one, Target):
        return getattr(one, "unit", "")
    quantity = one.quantity
    if quantity == "inertia":
        return UNIT_OF["mass" if one.owner + 1 in case.masses else quantity]
    if quantity not in ("stiffness", "compliance", "damping"):
        return ""
    spring = one.owner - case.among_devices.stop
    is_straight = spring >= 0 and case.is_straight(case.springs[spring])
    return UNIT_OF[STRAIGHT[quantity] if is_straight else quantity]


def _of_node(node: Node, subject: Subject) -> str:
    """The unit of a table, or of what is left of it; nothing where that takes more thought."""
    if isinstance(node, Selection):
        if not isinstance(subject, Transmission):
            return subject.unit_of(node.table)
        if node.table == OMEGA:
            return UNIT_OF["si_speed"]
        quantity = BY_NAME.get(node.table)
        return UNITS[quantity.unit].text if quantity and quantity.unit else ""
    if isinstance(node, Applied) and node.name in KEEPING:
        units = {_of_node(one, subject) for one in node.operands}
        return units.pop() if len(units) == 1 else ""
    return ""
