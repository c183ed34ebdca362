"""Results as text in each format: of a case alone, or of one among several on a stream.

Each writer is imported when it is needed.
"""

from __future__ import annotations

from typing import Literal, NamedTuple

from vstatics.cli import files
from vstatics.cli.cases import CalculatedCase
from vstatics.statics.results import Language

OutputFormat = Literal["listing", "json", "csv", "jsonl"]

SUFFIXES: dict[OutputFormat, str] = {
    "listing": ".lst",
    "json": ".json",
    "csv": ".csv",
    "jsonl": ".jsonl",
}


def format_of_name(name: str) -> OutputFormat:
    """The format that the suffix of a file tells, a listing where it tells none.

    >>> format_of_name("a.JSON"), format_of_name("a.txt")
    ('json', 'listing')
    """
    named = (form for form, suffix in SUFFIXES.items() if name.lower().endswith(suffix))
    return next(named, "listing")


class Frame(NamedTuple):
    """What stands around the parts of a stream."""

    first: str
    between: str
    last: str


def alone(outcome: CalculatedCase, output_format: OutputFormat, lang: Language) -> str:
    """The text of a case by itself; one that failed has none."""
    if output_format == "jsonl":
        return part(outcome, output_format, lang)
    if outcome.results is None:
        return ""
    if output_format == "json":
        from vstatics.writers import result_json

        return result_json.write([result_json.document(outcome.results)], several=False)
    if output_format == "csv":
        from vstatics.writers import result_csv

        return result_csv.write([(outcome.file, outcome.results)], several=False)
    from vstatics.writers import listing

    return listing.write(outcome.results, lang)


def part(outcome: CalculatedCase, output_format: OutputFormat, lang: Language) -> str:
    """The text of a case among several; one that failed has one in JSON only."""
    if output_format in ("json", "jsonl"):
        from vstatics.writers import result_json

        if outcome.results is None:
            document = result_json.failure(outcome.file, outcome.problems)
        else:
            document = result_json.document(outcome.results)
        if output_format == "json":
            return result_json.text(document)
        return result_json.line(document)
    if outcome.results is None:
        return ""
    if output_format == "csv":
        from vstatics.writers import result_csv

        return result_csv.rows(outcome.file, outcome.results)
    from vstatics.writers import listing

    return f"==> {outcome.file} <==\n{listing.write(outcome.results, lang)}"


def encoded(text: str, output_format: OutputFormat) -> bytes:
    """The text as bytes: safe to print, but CSV, which has no escapes, is as it is."""
    return files.encoded(text, as_is=output_format == "csv")


def frame(output_format: OutputFormat) -> Frame:
    """What stands before the first part of a stream, between parts, and after the last."""
    if output_format == "json":
        return Frame("[\n", ",\n", "\n]\n")
    if output_format == "csv":
        from vstatics.writers import result_csv

        return Frame(result_csv.head(several=True), "", result_csv.tail(several=True))
    return Frame("", "\n" if output_format == "listing" else "", "")
