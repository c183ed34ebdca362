"""Problems of files in formats for CI: GitHub annotations and SARIF 2.1.0."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from typing import Any

from vstatics.core.errors import Problem
from vstatics.core.messages.catalogue import explained

_COMMANDS = {"error": "error", "warning": "warning", "note": "notice"}
"""Workflow command of GitHub for each severity."""
SCHEMA = "https://json.schemastore.org/sarif-2.1.0.json"


def github(problems: Iterable[Problem]) -> str:
    """Return a line for each problem, which GitHub displays as an annotation of the file.

    >>> from vstatics.core.errors import Place
    >>> place = Place("scenarios/../a,b.yaml", 3, 7)
    >>> print(github([Problem("E107", "read 100%, expected less", place=place)]), end="")
    ::error file=a%2Cb.yaml,line=3,col=7,title=E107::read 100%25, expected less
    """
    lines = []
    for problem in problems:
        parts = {"title": problem.id}
        if problem.place:
            file, line, column, _ = problem.place
            where = {"line": str(line), "col": str(column)} if line else {}
            parts = {"file": _relative(file), **where, **parts}
        properties = ",".join(
            f"{key}={_data(value).replace(':', '%3A').replace(',', '%2C')}"
            for key, value in parts.items()
        )
        lines.append(f"::{_COMMANDS[problem.severity]} {properties}::{_data(problem.message)}\n")
    return "".join(lines)


def _relative(file: str) -> str:
    return os.path.relpath(file).replace(os.sep, "/")


def _data(text: str) -> str:
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def sarif(problems: Sequence[Problem]) -> dict[str, Any]:
    """Return the problems as a SARIF run, with a rule for each id.

    >>> from vstatics.core.errors import Place
    >>> log = sarif([Problem("E107", "read 0", place=Place("my box.yaml", 3, 7))])
    >>> [result] = log["runs"][0]["results"]
    >>> result["ruleId"], result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"]
    ('E107', 'my%20box.yaml')
    """
    ids = sorted({problem.id for problem in problems})
    rules = [
        {
            "id": message.id,
            "shortDescription": {"text": message.cause},
            "help": {"text": message.remedy},
            "defaultConfiguration": {"level": message.severity},
        }
        for message in map(explained, ids)
    ]
    results = [
        {
            "ruleId": problem.id,
            "ruleIndex": ids.index(problem.id),
            "level": problem.severity,
            "message": {"text": problem.message},
            "locations": _locations(problem),
        }
        for problem in problems
    ]
    run = {
        "tool": {"driver": {"name": "vstatics", "rules": rules}},
        "columnKind": "unicodeCodePoints",
        "results": results,
    }
    return {"$schema": SCHEMA, "version": "2.1.0", "runs": [run]}


def _locations(problem: Problem) -> list[dict[str, Any]]:
    if problem.place is None:
        return []
    from urllib.parse import quote  # costs start-up time

    file, line, column, _ = problem.place
    place: dict[str, Any] = {"artifactLocation": {"uri": quote(_relative(file))}}
    if line:
        place["region"] = {"startLine": line, "startColumn": column}
    return [{"physicalLocation": place}]
