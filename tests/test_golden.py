"""Golden files: the results of every shipped case, as this program wrote them.

They are written by the program itself, so they show change and prove nothing; truth is
in `published/` and in closed forms. ``pytest tests/test_golden.py --regenerate`` (or
``make golden``) rewrites them and fails where something changed, showing the
difference; the next run is green.
"""

import difflib
import json
from pathlib import Path
from typing import Any

import pytest

from tests.commands import CASES, SHIPPED, vstatics
from vstatics.core.comparison.numbers import differences
from vstatics.core.readers.results import read_results
from vstatics.core.tables.quantities import QUANTITIES

GOLDEN = Path(__file__).parent / "golden"
FORMATS = {"lst": "listing", "json": "json"}
WRITTEN = {f"{path.name}.{suffix}": path for path in SHIPPED for suffix in FORMATS}
NAMES_OF_TABLES = {quantity.name for quantity in QUANTITIES}


def besides_tables(text: str) -> dict[str, Any]:
    """A result without its tables and its program: the case, the messages, the conventions."""
    left_out = NAMES_OF_TABLES | {"program"}
    document = json.loads(text)
    return {key: value for key, value in document.items() if key not in left_out}


def changes(name: str, new: str, old: str) -> list[str]:
    """What differs: in a listing any character, in JSON numbers beyond rounding."""
    if name.endswith(".json"):
        (actual,), (expected,) = (read_results(text.encode(), name) for text in (new, old))
        found = [str(difference) for difference in differences(actual, expected)]
        if found or besides_tables(new) == besides_tables(old):
            return found
    lines = old.splitlines(), new.splitlines()
    return list(difflib.unified_diff(*lines, "golden", "now", lineterm="", n=1))


def judged(name: str, new: str, golden: Path, *, regenerate: bool) -> None:
    """Compare with the golden file; write it where it is missing or to be written anew."""
    if not golden.exists():
        golden.write_text(new, "utf-8")
        pytest.fail(f"{golden.name} was missing and is written now: read it before you keep it")
    found = changes(name, new, golden.read_text("utf-8"))
    if found and regenerate:
        golden.write_text(new, "utf-8")
    if found:
        what = "is rewritten" if regenerate else "differs (make golden rewrites it)"
        pytest.fail("\n".join([f"{golden.name} {what}:", *found]))


@pytest.mark.parametrize("name", WRITTEN)
def test_result_is_that_of_the_golden_file(name: str, *, regenerate: bool) -> None:
    said = vstatics("run", WRITTEN[name], "-f", FORMATS[name.rpartition(".")[2]])
    assert said.status == 0
    if "which is not installed here" in said.err:
        pytest.skip("a key of the case is of an annex that is not installed")
    judged(name, said.out, GOLDEN / name, regenerate=regenerate)


def test_no_golden_file_is_left_over() -> None:
    assert {path.name for path in GOLDEN.iterdir()} <= set(WRITTEN)


def test_a_change_fails_once_when_rewritten_and_always_when_not(tmp_path: Path) -> None:
    """So does a file that is missing, and written."""
    golden = tmp_path / "old.lst"
    with pytest.raises(pytest.fail.Exception, match="was missing"):
        judged("old.lst", "1.000\n", golden, regenerate=False)
    judged("old.lst", "1.000\n", golden, regenerate=False)
    for _ in range(2):
        with pytest.raises(pytest.fail.Exception, match="differs"):
            judged("old.lst", "2.000\n", golden, regenerate=False)
    with pytest.raises(pytest.fail.Exception, match=r"rewritten:\n(.*\n)+-1\.000\n\+2\.000"):
        judged("old.lst", "2.000\n", golden, regenerate=True)
    judged("old.lst", "2.000\n", golden, regenerate=True)


def test_rounding_is_no_change_of_json_but_a_message_is() -> None:
    text = vstatics("run", CASES / "self-locking.yaml", "-f", "json").out
    ratio = json.loads(text)["ratio"][0]
    assert changes("x.json", text.replace(repr(ratio), repr(ratio + 1e-12)), text) == []
    assert changes("x.json", text.replace(repr(ratio), repr(ratio + 1e-6)), text) != []
    assert changes("x.json", text.replace("self-locking", "stuck"), text) != []
