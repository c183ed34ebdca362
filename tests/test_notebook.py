"""docs/notebook.ipynb runs from its first cell to its last, and shows what it says it shows.

`pytest tests/test_notebook.py --regenerate` writes what the cells show into it.
"""

import ast
import json
import os
import re
from pathlib import Path
from typing import Any

import pytest

from tests.commands import ROOT, json_file
from tests.installed import skip_without, used_in

NOTEBOOK = ROOT / "docs" / "notebook.ipynb"
TAG = re.compile(r"<style.*?</style>|<[^>]*>", re.DOTALL)
"""Of HTML: pandas writes others from version to version."""
SHOWN = {"text/html": "_repr_html_", "image/svg+xml": "_repr_svg_"}


@pytest.mark.slow
def test_the_notebook_shows_what_it_says(folder: Path, request: pytest.FixtureRequest) -> None:
    skip_without(*used_in(NOTEBOOK.read_text("utf-8")))
    for extra in ("matplotlib", "pandas", "flint", "xarray", "scipy", "numba"):
        pytest.importorskip(extra)
    document = json_file(NOTEBOOK)
    names: dict[str, Any] = {}
    ran = 0
    for cell in document["cells"]:
        if cell["cell_type"] == "code":
            ran += 1
            found = outputs("".join(cell["source"]), names, ran)
            if not request.config.getoption("--regenerate"):
                assert texts(found) == texts(cell["outputs"]), "".join(cell["source"])
            cell["outputs"], cell["execution_count"] = found, ran
    assert ran > 20
    assert list(folder.iterdir()) == []
    if request.config.getoption("--regenerate"):
        written = json.dumps(document, indent=1, ensure_ascii=False) + "\n"
        NOTEBOOK.write_text(written, "utf-8")


def outputs(source: str, names: dict[str, Any], number: int) -> list[dict[str, Any]]:
    """Run a cell; what its last expression shows."""
    body = ast.parse(source).body
    last = body.pop() if body and isinstance(body[-1], ast.Expr) else None
    exec(compile(ast.Module(body, []), f"cell {number}", "exec"), names)  # noqa: S102
    if not isinstance(last, ast.Expr):
        return []
    value = eval(compile(ast.Expression(last.value), f"cell {number}", "eval"), names)  # noqa: S307
    if value is None:
        return []
    data = {kind: getattr(value, show)() for kind, show in SHOWN.items() if hasattr(value, show)}
    data["text/plain"] = repr(value)
    return [
        {
            "data": {kind: text.splitlines(keepends=True) for kind, text in data.items()},
            "execution_count": number,
            "metadata": {},
            "output_type": "execute_result",
        }
    ]


def texts(found: list[dict[str, Any]]) -> list[Any]:
    """What is compared: all words; pictures differ by the version of what draws them."""
    kept = [
        {
            kind: TAG.sub(" ", "".join(lines)).split() if kind == "text/html" else lines
            for kind, lines in one["data"].items()
            if kind != "image/svg+xml"
        }
        for one in found
    ]
    kinds = [sorted(one["data"]) for one in found]
    return [kept, kinds]


def test_the_notebook_has_no_path_of_this_machine() -> None:
    text = NOTEBOOK.read_text("utf-8")
    assert os.fspath(ROOT) not in text
