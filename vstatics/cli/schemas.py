"""All JSON Schemas, as they stand in ``schemas/``: ``python -m vstatics.cli.schemas FOLDER``."""

from __future__ import annotations

import json
import os
import sys
from typing import Any

from vstatics.cli import problem_json
from vstatics.cli.simulate import schemas as simulate_schemas
from vstatics.cli.synth import schemas as synth_schemas
from vstatics.cli.torsion import dump
from vstatics.cli.torsion import schemas as torsion_schemas
from vstatics.explain import schema as explain
from vstatics.flow import schema as flow
from vstatics.readers.named import schema as case
from vstatics.summary import schema as summary
from vstatics.writers import schema as result


def schemas() -> dict[str, dict[str, Any]]:
    """By the name of what each describes."""
    of_case = case.json_schema()
    return {
        "case": of_case,
        "result": result.json_schema(of_case),
        "flow": flow.json_schema(),
        "summary": summary.json_schema(),
        "explain": explain.json_schema(),
        **torsion_schemas.json_schemas(),
        **simulate_schemas.json_schemas(),
        **synth_schemas.json_schemas(),
        "dump": dump.json_schema(),
        "check": problem_json.json_schema(),
    }


def text(schema: dict[str, Any]) -> str:
    """A schema as it stands in its file."""
    return json.dumps(schema, indent=2, ensure_ascii=False) + "\n"


if __name__ == "__main__":
    for name, made in schemas().items():
        path = os.path.join(sys.argv[1], f"{name}.schema.json")  # noqa: PTH118
        with open(path, "w", encoding="utf-8") as file:  # noqa: PTH123
            file.write(text(made))
