"""Documents that are no case: how each kind is recognised, and a scenario with its case."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

from vstatics.core import readers
from vstatics.core.cli.shared import files
from vstatics.core.errors import Problem, ReadError, of_file
from vstatics.core.readers.kinds import is_of_kind

if TYPE_CHECKING:
    from vstatics.simulation.scenario.file import ScenarioDocument, ScenarioFile

NO_TEXTS: Mapping[str, bytes] = {}


class DocumentKind(NamedTuple):
    """Of documents that are no case, which a deck, YAML or JSON may be."""

    mark: bytes
    """All of them have it and hardly a case, so that cases need no imports to be told apart."""
    is_one: Callable[[bytes, str], bool]
    """By the text and the name of its file."""
    told: str = ""
    """Where a case is expected."""


def _is_listing(data: bytes, _name: str) -> bool:
    from vstatics.synthesis.boxes.reading import is_listing

    return is_listing(data)


def _is_sweep(data: bytes, _name: str) -> bool:
    from vstatics.core.readers.sweep_tables import is_sweep

    return is_sweep(data)


KINDS = {
    "boxes": DocumentKind(
        b'"searched"',
        _is_listing,
        "these are found boxes, expected a case; "
        "plot --kind boxes, report and summary take one such file",
    ),
    "scenario": DocumentKind(
        b"duration",
        partial(is_of_kind, "scenario"),
        "this is a scenario, expected a case; simulate, plot, report and sweep take scenarios",
    ),
    "sweep file": DocumentKind(
        b"case",
        partial(is_of_kind, "sweep file"),
        "this is a sweep file, expected a case; `vstatics sweep --file` takes it",
    ),
    "sweep": DocumentKind(b"", _is_sweep),
}


def is_a(kind: str, data: bytes, name: str) -> bool:
    """Whether a text is a document of this kind, a key of `KINDS`.

    >>> is_a("scenario", b"{case: box.yaml, duration: 6}", "up.yaml")
    True
    """
    known = KINDS[kind]
    return known.mark in data and known.is_one(data, name)


def no_case(data: bytes, name: str, taken: Collection[str] = ()) -> list[Problem]:
    """What is to be said of a text that is no case, but of a kind that is not taken either."""
    others = (kind for kind, known in KINDS.items() if known.told and kind not in taken)
    return [of_file("E004", name, KINDS[kind].told) for kind in others if is_a(kind, data, name)]


def scenario_with_case(
    data: bytes,
    name: str,
    input_format: readers.Format | None = None,
    case: str | None = None,
    output: str | None = None,
    texts: Mapping[str, bytes] = NO_TEXTS,
) -> ScenarioFile:
    """A scenario of a text, with the case that it names, or that is given.

    Texts stand in place of what is in the files of their names.

    Raises
    ------
    ReadError
    UsageError
        If the case would be overwritten by the output.
    """
    from vstatics.simulation.scenario.file import read_scenario

    document = read_scenario(data, name)
    text, named = case_of(document, case, output, texts)
    try:
        reading = readers.read(text, named, input_format)
    except ReadError as error:
        raise ReadError(no_case(text, named) or error.problems) from None
    read = document.with_case(reading)
    if read.samples:
        from vstatics.sweep.build import sampled_numbers
        from vstatics.sweep.variants.subject import Document, VariedScenario

        own, of_case = Document(data, name), Document(text, named)
        sampled_numbers(VariedScenario(own, of_case, case_format=input_format))
    return read


def case_of(
    document: ScenarioDocument,
    case: str | None = None,
    output: str | None = None,
    texts: Mapping[str, bytes] = NO_TEXTS,
) -> tuple[bytes, str]:
    """What the file of the case of a scenario holds, and its name.

    Raises
    ------
    ReadError
        If it can't be read; at the place where the scenario names it, if that does.
    UsageError
        If it would be overwritten by the output.
    """
    file = case or document.case_file
    if not file:
        raise document.no_case("`case` is missing: the file of the case")
    files.spare([file], output)
    if file in texts:
        return texts[file], file
    try:
        data, name = files.read_input(file, regular=not case)
    except ReadError as error:
        if case:
            raise
        why = f"{file} {error.problems[0].message}"
        raise document.no_case(why) from None
    if not case:
        document.refuse_foreign(data, name)
    return data, name
