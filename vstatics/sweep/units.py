"""Units of varied numbers and columns, for the attributes of a dataset."""

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
"""Names of functions whose value has the unit of the operands."""


def units_of(plan: SweepPlan) -> dict[str, str]:
    """Return the known units of varied numbers and columns, by name.

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
    units_by_name = {varied.name: _of_varied(varied, case) for varied in plan.variants.targets}
    each = (part.expression.node for part in plan.columns.parts for _ in part.cells)
    units = (_of_node(node, subject) for node in each)
    units_by_name |= zip(plan.headings, units, strict=True)
    return {name: unit for name, unit in units_by_name.items() if unit}


def _of_varied(varied: Varied, case: Transmission) -> str:
    if isinstance(varied, CasePath):
        if varied.unit or varied.measure is None:
            return varied.unit
        return "W" if varied.measure == "power" else UNIT_OF[varied.measure]
    if not isinstance(varied, Target):
        return getattr(varied, "unit", "")
    quantity = varied.quantity
    if quantity == "inertia":
        return UNIT_OF["mass" if varied.owner + 1 in case.masses else quantity]
    if quantity not in ("stiffness", "compliance", "damping"):
        return ""
    spring = varied.owner - case.among_devices.stop
    is_straight = spring >= 0 and case.is_straight(case.springs[spring])
    return UNIT_OF[STRAIGHT[quantity] if is_straight else quantity]


def _of_node(node: Node, subject: Subject) -> str:
    """Return the unit of an expression that keeps the unit of a table; "" for other expressions."""
    if isinstance(node, Selection):
        if not isinstance(subject, Transmission):
            return subject.unit_of(node.table)
        if node.table == OMEGA:
            return UNIT_OF["si_speed"]
        quantity = BY_NAME.get(node.table)
        return UNITS[quantity.unit].text if quantity and quantity.unit else ""
    if isinstance(node, Applied) and node.name in KEEPING:
        units = {_of_node(operand, subject) for operand in node.operands}
        return units.pop() if len(units) == 1 else ""
    return ""
