"""Readers of written results (listing, JSON or rows) into tables of numbers, for comparison."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Mapping, Sequence
from typing import Any

from vstatics.core.errors import ReadError, plural, quoted
from vstatics.core.model.parts import mechanism_name
from vstatics.core.model.transmission import Transmission
from vstatics.core.readers import Format, read
from vstatics.core.readers.deck.text import SPRING, decode, head, scan
from vstatics.core.readers.reading import Source
from vstatics.core.readers.result_rows import (
    checked,
    finite_figure,
    is_csv,
    is_parquet,
    no_result,
    read_csv,
    read_parquet,
)
from vstatics.core.tables.names import BEFORE_NAME, plain_name
from vstatics.core.tables.quantities import PRINTED, QUANTITIES
from vstatics.core.tables.written_results import Figure, Figures, WrittenResult

FORMAT = "vstatics-result"
TAKEN = (
    "expected a result of `vstatics run` (listing, JSON, JSON lines, CSV, Parquet) or a sweep "
    "(CSV, JSON lines, NPZ, Parquet)"
)
CASE = (
    "a case, not a result; create a result with `vstatics run CASE -f json -o RESULT.json`, or "
    "show two cases side by side with `vstatics summary CASE OTHER`"
)
OTHERS = {
    "remedy": "an explanation of `vstatics check --explain`",
    "severity": "a problem that `vstatics check` reports",
    "changed": "the output of `vstatics compare`",
    "gears": CASE,
}
"""Keys of JSON documents that are not results, with descriptions of the documents."""
_SORTED = (
    "has sorted keys, so the names in its case no longer have the order of its tables; write it "
    "with `vstatics run` again, and keep programs that format JSON from sorting keys"
)
NAMED_FILE = re.compile(r"==> (.+) <==$")
"""Pattern of the line with the file name above each of several listings."""

MERGE_CONFLICT = re.compile("^<{7} ", re.MULTILINE)
"""Pattern of the mark that git writes at the start of a conflict."""


def read_results(data: bytes, file: str) -> list[WrittenResult]:
    """Read results from a listing, JSON, JSON lines, CSV or Parquet, in the order of the file.

    Raises
    ------
    ReadError
        If the text is not a result.
    """
    if is_parquet(data):
        return read_parquet(data, file)
    text = decode(data, file)
    if mark := MERGE_CONFLICT.search(text):
        message = "the file has an unresolved merge conflict"
        raise no_result(message, file, text.count("\n", 0, mark.start()) + 1)
    if text.lstrip()[:1] in ("{", "["):
        try:
            content = json.loads(text)
        except (RecursionError, ValueError) as error:
            if isinstance(error, json.JSONDecodeError) and _is_lines(text, error):
                return _read_lines(text, file)
            raise _no_json(error, file) from None
        documents = content if isinstance(content, list) else [content]
        if not documents:
            raise no_result(
                f"an empty array, as `check -f json` writes if there are no messages; {TAKEN}", file
            )
        return [_report(document, file, number) for number, document in enumerate(documents, 1)]
    if is_csv(text):
        return read_csv(text, file)
    return _read_listing(text, file)


def _is_lines(text: str, error: json.JSONDecodeError) -> bool:
    """Return whether a text that is not valid JSON is JSON lines, possibly with a faulty line.

    Either the first object ends on its line, or objects begin on several lines.
    """
    if text.lstrip()[:1] != "{":
        return False
    ended = error.msg == "Extra data" and "\n" not in text[: error.pos].strip()
    begun = [line for line in text.split("\n") if line[:1] == "{" != line.strip()]
    return ended or len(begun) > 1


def _read_lines(text: str, file: str) -> list[WrittenResult]:
    """Read JSON lines, each with a result, and skip empty lines."""
    results: list[WrittenResult] = []
    for number, line in enumerate(text.split("\n"), 1):
        if not line.strip():
            continue
        try:
            results.append(_report(json.loads(line), file, len(results) + 1, number))
        except (RecursionError, ValueError) as error:
            raise _no_json(error, file, number) from None
    return results


def _no_json(error: Exception, file: str, line: int = 0) -> ReadError:
    if isinstance(error, json.JSONDecodeError):
        return no_result(
            f"the file is not JSON: {error.msg}", file, line or error.lineno, error.colno
        )
    reason = "nested too deeply" if isinstance(error, RecursionError) else error
    return no_result(f"the JSON cannot be read: {reason}", file, line)


def _report(document: Any, file: str, number: int, line: int = 0) -> WrittenResult:
    if not isinstance(document, dict):
        raise no_result(f"result {number} is not a JSON object; {TAKEN}", file, line)
    if "errors" in document:
        return WrittenResult({}, None, printed=False, errors=True, file=_file(document))
    tables = {}
    for quantity in QUANTITIES:
        # In version 1, results had names of the deck.
        key = next((name for name in (quantity.name, quantity.deck_name) if name in document), "")
        if key:
            rows = document[key]
            try:
                rows_of_table = [rows] if quantity.rows == "one" else rows
                figures = [[_from_json(value) for value in row] for row in rows_of_table]
            except (TypeError, ValueError, OverflowError):
                raise no_result(
                    f"{key} of result {number} is not a table of numbers", file, line
                ) from None
            tables[quantity.name] = figures
    if not tables:
        raise no_result(_no_tables(document, number), file, line)
    mappings = [part for part in (document, document.get("case")) if isinstance(part, dict)]
    if document.get("format") == FORMAT and any([*part] == sorted(part) for part in mappings):
        raise no_result(f"result {number} {_SORTED}", file, line)
    case = _case(json.dumps(document.get("case")), "json")
    given_rows = document.get("rows")
    rows = _row_names(given_rows if isinstance(given_rows, dict) else {}, tables)
    return WrittenResult(tables, case, printed=False, rows=rows, file=_file(document))


def _no_tables(document: Mapping[str, Any], number: int) -> str:
    """Return the message about a document without tables, such as the output of `check`."""
    form = document.get("format")
    if isinstance(form, str) and form != FORMAT and form.startswith("vstatics-"):
        kind = f"a document of vstatics {form.removeprefix('vstatics-')}"
    else:
        kind = next((description for key, description in OTHERS.items() if key in document), "")
    if kind:
        return f"result {number} is {kind}; {TAKEN}"
    known = ", ".join(quantity.name for quantity in QUANTITIES[:3])
    keys = ", ".join(map(quoted, [*document][:3])) + ", ..." * (len(document) > 3)
    has = f"has {plural('key', len(document))} {keys}, none" if keys else "has none"
    return f"result {number} {has} of the tables {known}, ...; {TAKEN}"


def _file(document: Mapping[str, Any]) -> str:
    """Return the file name in a result; empty if missing."""
    file = document.get("case" if "errors" in document else "file")
    return file if isinstance(file, str) else ""


def _row_names(given: Mapping[str, Any], tables: Mapping[str, Figures]) -> dict[str, list[str]]:
    """Return the row names of each table that has as many names as rows."""
    named = ((plain_name(key), names) for key, names in given.items())
    return {
        table: [str(name) for name in names]
        for table, names in named
        if table in tables and isinstance(names, list) and len(names) == len(tables[table])
    }


def _from_json(value: Any) -> Figure:
    if isinstance(value, str):
        raise TypeError(value)
    return finite_figure(value)


def _case(text: str, kind: Format) -> Transmission | None:
    """Return the case that a result contains; None without a case."""
    try:
        return read(text.encode(), "", format=kind).case
    except ReadError:
        return None


def _read_listing(text: str, file: str) -> list[WrittenResult]:
    """Read the reports of a listing. A new report begins at each `KJG=` that follows a table."""
    reports = []
    tables: dict[str, Figures] = {}
    names: dict[str, list[str]] = {}
    first, table, report_file, next_file = 0, "", "", ""
    lines = Source(file, text).lines
    for number, line in enumerate([*lines, "KJG="]):
        field = head(line)
        if field == "KJG":
            if tables:
                row_names = _row_names(names, tables)
                result = WrittenResult(tables, None, printed=True, rows=row_names, file=report_file)
                reports.append(_with_case(checked(result, file, number), lines[first:number]))
                tables, names, first, table, report_file = {}, {}, number, "", ""
            report_file, next_file = next_file or report_file, ""
        elif named_file := NAMED_FILE.match(line):
            next_file, table = named_file[1], ""
        elif field in PRINTED:
            table = PRINTED[field].name
            tables.setdefault(table, [])
        elif table and line.strip():
            numbers, has_name, name = line.partition(BEFORE_NAME)
            figures = _figures(numbers.split())
            if figures is None:
                table = ""
            else:
                tables[table].append(figures)
                names.setdefault(table, []).extend([name.strip()] * bool(has_name))
    if not reports:
        is_case = any(head(line) or line.startswith("gears:") for line in lines)
        nothing = f"the file contains no table of results; {TAKEN}"
        raise no_result(f"the file is {CASE}" if is_case else nothing, file)
    return reports


def _with_case(result: WrittenResult, lines: Sequence[str]) -> WrittenResult:
    """Return the result of a listing with the case from its head.

    The head is a deck, which cannot contain springs. For a case with springs, only names are read.
    """
    springs = [line.partition(": ")[2] for line in lines if line.startswith(SPRING)]
    if not springs:
        return result._replace(case=_case("\n".join(lines), "deck"))
    names = {name[:2]: name[2] for name in scan(Source("", "\n".join(lines))).names}
    elements = result.rows.get("slip_speeds", ())
    columns, gears = (
        max(map(len, result.tables.get(table, ())), default=0)
        for table in ("distribution_matrix", "speeds")
    )
    sets = range(1, columns - len(elements) - len(springs) + 1)
    mechanisms = [names.get(("D", str(number)), mechanism_name(number)) for number in sets]
    return result._replace(
        gears=[names.get(("P", str(number)), str(number)) for number in range(1, gears + 1)],
        devices=[*elements, *mechanisms, *springs],
    )


def _figures(words: Sequence[str]) -> list[Figure] | None:
    """Return the numbers of a printed row; None if the row contains words."""
    figures = []
    for word in words:
        if set(word) == {"*"}:
            figures.append(Figure(math.nan))
            continue
        number = word.upper().replace("D", "E")
        mantissa, _, exponent = number.partition("E")
        _, point, decimals = mantissa.partition(".")
        try:
            value = float(number)
            scale = int(exponent or 0) - len(decimals)
            slack = 0.5 * 10.0**scale if point else 0.0
        except (ValueError, OverflowError):
            return None
        if math.isinf(value):
            return None
        figures.append(Figure(value, slack))
    return figures
