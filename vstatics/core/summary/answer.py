"""Record that `vstatics summary` writes as JSON."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, NamedTuple

from vstatics.core.summary import Summary
from vstatics.core.summary.design_table import Design
from vstatics.core.summary.extremes import Largest, Margin, Needed
from vstatics.core.summary.inertia import GearInertia
from vstatics.core.summary.shifts import Transition
from vstatics.core.summary.unused_sets import Combination
from vstatics.core.tables.answer import Flat, Provided, Sometimes, document
from vstatics.core.tables.ports import PortTable, port_tables


@document("vstatics-summary")
class SummaryAnswer(NamedTuple):
    """Summary of a case as a record for output."""

    name: str
    design: Flat[Design]
    transitions: Sequence[Transition]
    ports: Sequence[PortTable]
    largest: Mapping[str, Sequence[Largest]]
    sensitivity: Mapping[str, Sequence[float]]
    efficiency_sensitivity: Mapping[str, Sequence[float]]
    margins: Sometimes[Sequence[Margin]]
    needed_capacity: Sometimes[Sequence[Needed]]
    inertia: Sometimes[Sequence[GearInertia]]
    vehicle: Sometimes[Annotated[object, Provided("Performance")]]
    duty: Sometimes[Annotated[object, Provided("DutyResults")]]
    damage: Sometimes[Annotated[object, Provided("Damages")]]
    """Damage of components over a duty cycle that has points."""
    combinations: Sometimes[Sequence[Combination]]


def summary_answer(summary: Summary) -> SummaryAnswer:
    """Return a summary as a record for output."""
    case = summary.results.case
    names = [mechanism.name for mechanism in case.mechanisms]
    return SummaryAnswer(
        case.name,
        summary.design,
        summary.transitions,
        port_tables(summary.results),
        summary.largest,
        dict(zip(names, summary.sensitivities.T.tolist(), strict=True)),
        dict(zip(names, summary.efficiency_sensitivities.T.tolist(), strict=True)),
        summary.margins or None,
        summary.needed or None,
        summary.inertias or None,
        summary.vehicle,
        summary.cycle,
        summary.cycle and summary.cycle.damage,
        summary.combinations,
    )
