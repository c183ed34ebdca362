"""JSON Schemas of ``schemas/``, written by ``python -m vstatics.core.cli.schemas FOLDER``."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Sequence
from typing import Any

from vstatics.core.annexes import Schema, annexes, module
from vstatics.core.cli.check import ProblemRecord
from vstatics.core.comparison.verdicts import Verdict
from vstatics.core.explain.answer import ExplanationAnswer
from vstatics.core.explain.exercise import SolvedExercise
from vstatics.core.flow.answer import FlowAnswer
from vstatics.core.readers.named import schema as case
from vstatics.core.summary.answer import SummaryAnswer
from vstatics.core.tables.answer import documents_of, of_file, schema
from vstatics.core.writers import schema as result

ANSWERS = {
    "flow": ("Power of gears, of vstatics flow", FlowAnswer),
    "summary": ("Summary of a case, of vstatics summary", SummaryAnswer),
    "explain": ("Gears explained, of vstatics explain", ExplanationAnswer),
    "exercise": ("A gear as an exercise, of vstatics explain --solution", SolvedExercise),
}
"""Title and type of each schema by file name, for outputs with a document for each case."""
OTHERS = {
    "check": ("Problems of cases, by vstatics check", Sequence[ProblemRecord]),
    "compare": ("What changed between results, of vstatics compare", Verdict),
}
"""Title and type of each schema by file name, for outputs with a single document."""


def schemas() -> dict[str, dict[str, Any]]:
    """Return all JSON schemas by file name."""
    of_case = case.json_schema()
    return {
        "case": of_case,
        "result": result.json_schema(of_case),
        **{name: documents_of(name, *of) for name, of in ANSWERS.items()},
        **{name: of_file(name, title, schema(kind)) for name, (title, kind) in OTHERS.items()},
        **{name: _of_annex(name, of) for annex in annexes() for name, of in annex.schemas.items()},
    }


def _of_annex(name: str, declared: Schema) -> dict[str, Any]:
    described = getattr(module(declared.module), declared.type)
    if not declared.title:
        own_schema: dict[str, Any] = described()
        return own_schema
    if declared.documents:
        return documents_of(name, declared.title, described)
    return of_file(name, declared.title, schema(described))


def text(schema: dict[str, Any]) -> str:
    """Return the text of a schema file."""
    return json.dumps(schema, indent=2, ensure_ascii=False) + "\n"


if __name__ == "__main__":
    for name, described in schemas().items():
        path = os.path.join(sys.argv[1], f"{name}.schema.json")  # noqa: PTH118
        with open(path, "w", encoding="utf-8") as file:  # noqa: PTH123
            file.write(text(described))
