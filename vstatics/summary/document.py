"""A summary as JSON, with all digits."""

from __future__ import annotations

from typing import Any

from vstatics.summary import Summary
from vstatics.tables.ports import port_tables
from vstatics.writers.plain_json import plain_data
from vstatics.writers.ports import port_document

FORMAT = "vstatics-summary"
VERSION = 1


def document(summary: Summary) -> dict[str, Any]:
    """A summary as plain data."""
    case = summary.results.case
    mechanisms = [mechanism.name for mechanism in case.mechanisms]
    always: dict[str, Any] = {
        "format": FORMAT,
        "version": VERSION,
        "name": case.name,
        "gears": summary.design.gears,
        "forward": summary.design.forward,
        "spread": summary.design.spread,
        "transitions": [
            {**one._asdict(), "changes": one.changes, "kind": one.word}
            for one in summary.transitions
        ],
        "ports": [{"gear": one.gear, **port_document(one)} for one in port_tables(summary.results)],
        "largest": summary.largest,
        "sensitivity": dict(zip(mechanisms, summary.sensitivities.T.tolist(), strict=True)),
    }
    asked = {"duty": summary.cycle, "combinations": summary.combinations}
    more = {"margins": summary.margins or None, "inertia": summary.inertias or None, **asked}
    made: dict[str, Any] = plain_data(
        always | {key: value for key, value in more.items() if value is not None}
    )
    return made
