"""A summary as plain data for JSON, with all digits."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from typing import Any

from vstatics.summary import Summary

VERSION = 1


def document(summary: Summary) -> dict[str, Any]:
    """A summary as a mapping; what does not exist is None."""
    case = summary.results.case
    made = {
        "format": "vstatics-summary",
        "version": VERSION,
        "name": case.name,
        "gears": [_record(line) for line in summary.design.gears],
        "forward": list(summary.design.forward),
        "spread": _known(summary.design.spread),
        "transitions": [
            {**_record(one), "changes": one.changes, "kind": one.word}
            for one in summary.transitions
        ],
        "largest": {
            name: [_record(line) for line in lines] for name, lines in summary.largest.items()
        },
        "sensitivity": {
            mechanism.name: [_known(value) for value in row]
            for mechanism, row in zip(
                case.mechanisms, summary.sensitivities.T.tolist(), strict=True
            )
        },
    }
    if summary.margins:
        made["margins"] = [
            {**_record(one), "by_gear": [_known(value) for value in one.by_gear]}
            for one in summary.margins
        ]
    if summary.cycle is not None:
        made["duty"] = {
            "stages": [_record(stage) for stage in summary.cycle.stages],
            "efficiency": summary.cycle.efficiency,
        }
    if summary.combinations is not None:
        made["combinations"] = [_record(one) for one in summary.combinations]
    return made


def write(documents: Sequence[dict[str, Any]]) -> str:
    """Documents as text; several as an array."""
    made = documents[0] if len(documents) == 1 else list(documents)
    return json.dumps(made, indent=2, ensure_ascii=False, allow_nan=False) + "\n"


def _record(line: Any) -> dict[str, Any]:
    """A NamedTuple as a mapping."""
    return {name: _known(value) for name, value in line._asdict().items()}


def _known(value: Any) -> Any:
    return None if isinstance(value, float) and not math.isfinite(value) else value
