"""Closed-loop scenarios and tables of the repository: shipped ones, those of documents, of tests."""

from __future__ import annotations

import ast
import importlib
import re
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any, NamedTuple

import yaml

from tests.simulation.control.written import TWO_WHEELS

ROOT = Path(__file__).parents[3]
TESTS = Path(__file__).parent
WRITERS = ("simulated", "written")
"""Functions of the tests that take a scenario, and a case."""
FENCE = re.compile(r"<!-- file: (\S+) -->\n```yaml\n(.*?)^```$", re.MULTILINE | re.DOTALL)


class ClosedLoop(NamedTuple):
    """A scenario as a document of YAML, with the text of its case."""

    name: str
    document: dict[str, Any]
    case: str


def closed_loops() -> dict[str, ClosedLoop]:
    """Return every scenario of the repository that sets numbers, by name."""
    loops = [*_shipped(), *_documented(), *_tested()]
    return {loop.name: loop for loop in loops if loop.document.get("set")}


def _shipped() -> Iterator[ClosedLoop]:
    folder = ROOT / "cases/scenarios"
    for path in sorted(folder.glob("*.yaml")):
        document = yaml.safe_load(path.read_text())
        yield ClosedLoop(path.stem, document, (folder / document["case"]).read_text())


def _documented() -> Iterator[ClosedLoop]:
    for page in sorted((ROOT / "docs").rglob("*.md")):
        files = dict(FENCE.findall(page.read_text()))
        for name, text in files.items():
            document = yaml.safe_load(text)
            if isinstance(document, dict) and document.get("case") in files:
                yield ClosedLoop(f"{page.stem}-{name}", document, files[document["case"]])


def _tested() -> Iterator[ClosedLoop]:
    """Scenarios that tests write, with the first values of their parameters."""
    for path in sorted(TESTS.glob("test_*.py")):
        names = vars(importlib.import_module(f"tests.simulation.control.{path.stem}"))
        for function in ast.parse(path.read_text()).body:
            if isinstance(function, ast.FunctionDef):
                for number, texts in enumerate(_calls(function, names)):
                    document = _document(texts[0])
                    case = texts[1] if len(texts) > 1 else TWO_WHEELS
                    if document is not None:
                        yield ClosedLoop(f"{function.name}-{number}", document, case)


def _calls(function: ast.FunctionDef, names: dict[str, Any]) -> Iterator[list[str]]:
    """Arguments of the calls that write a scenario, as far as they are known without a run."""
    known = {**names, **_first_parameters(function, names)}
    for node in ast.walk(function):
        if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
            known[node.targets[0].id] = _value(node.value, known)
        if isinstance(node, ast.Call) and getattr(node.func, "id", "") in WRITERS and node.args:
            values = [_value(argument, known) for argument in node.args]
            if all(isinstance(value, str) for value in values):
                yield values


def _first_parameters(function: ast.FunctionDef, names: dict[str, Any]) -> dict[str, Any]:
    known: dict[str, Any] = {}
    for decorator in function.decorator_list:
        if isinstance(decorator, ast.Call) and len(decorator.args) > 1:
            keys, cases = (_value(argument, names) for argument in decorator.args[:2])
            if isinstance(cases, list) and cases:
                first = getattr(cases[0], "values", cases[0])
                if isinstance(keys, str):
                    known[keys] = first
                elif isinstance(keys, tuple) and isinstance(first, tuple):
                    known |= dict(zip(keys, first, strict=True))
    return known


def _value(node: ast.expr, names: dict[str, Any]) -> Any:
    """Return the value of an expression of a test; None if it needs a run."""
    calls = (part.func for part in ast.walk(node) if isinstance(part, ast.Call))
    if any(isinstance(call, ast.Name) and call.id in WRITERS for call in calls):
        return None
    try:
        return eval(compile(ast.Expression(node), "test", "eval"), dict(names))  # noqa: S307
    except Exception:  # noqa: BLE001 - names that only a run knows
        return None


def _document(text: str) -> dict[str, Any] | None:
    try:
        document = yaml.safe_load(text)
    except yaml.YAMLError:
        return None
    return document if isinstance(document, dict) and "duration" in document else None


def ramped(document: dict[str, Any]) -> dict[str, Any]:
    """Return a scenario with each number of `set` behind a ramp and a lag."""
    numbers = document["set"]
    document["set"] = {f"wanted_{name}": value for name, value in numbers.items()}
    states = document["states"] = {**(document.get("states") or {})}
    sequences = (document.get("sequences") or {}).values()
    steps = [step for one in sequences for step in (one if isinstance(one, list) else one["steps"])]
    given = [item for step in steps for item in step.get("set", {}).items()]
    for name, value in numbers.items():
        sizes = [abs(to) for key, to in given if key == name and isinstance(to, (int, float))]
        size = max([abs(value), 1.0, *sizes])
        ramp = f"{20 * size}*min(max((wanted_{name} - ramp_{name})/{0.02 * size}, -1), 1)"
        states[f"ramp_{name}"] = {"start": value, "rate": ramp}
        states[name] = {"start": value, "rate": f"(ramp_{name} - {name})/0.03"}
    for step in steps:
        settings = step.get("set", {}).items()
        step["set"] = {f"wanted_{key}" if key in numbers else key: to for key, to in settings}
    return document


def tables() -> list[list[list[float]]]:
    """Return the points of every table over one variable, and of laws over speed or angle."""
    homes = ("cases/scenarios", "yaml"), ("docs", "md"), ("tests/simulation", "py")
    paths = [path for folder, kind in homes for path in sorted((ROOT / folder).rglob(f"*.{kind}"))]
    text = "\n".join(path.read_text() for path in paths)
    curves: list[list[list[float]]] = []
    for points in re.findall(r"(?:\bpoints: |\b\w+: )(\[\[[-\d., \[\]e]+\]\])", text):
        try:
            rows = [[float(number) for number in row] for row in yaml.safe_load(points)]
        except (yaml.YAMLError, TypeError, ValueError):
            continue
        rises = all(first[0] < second[0] for first, second in pairwise(rows))
        if len(rows) > 1 and rises and all(len(row) == 2 for row in rows) and rows not in curves:
            curves.append(rows)
    return curves
