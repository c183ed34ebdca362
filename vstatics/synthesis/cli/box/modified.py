"""Options --keep and --free of `vstatics synth box`, for gearboxes that retain parts of a case."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import click

from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.cases import read_data
from vstatics.core.cli.shared.problems import Telling
from vstatics.core.cli.shared.values import named
from vstatics.core.errors import CaseError, ReadError, quoted, typed_number
from vstatics.synthesis.boxes.box import MOST_ELEMENTS, BoxSearch

OF_CASE = ("sets", "engaged", "meshed", "own_input", "own_output", "shafts", "fixed")
"""Fields of a search that follow from the case of --keep. Their options are refused."""
SPELLED = {
    "elements": "shift-elements",
    "meshed": "double-pinion",
    "own_input": "own-input",
    "own_output": "own-output",
    "steps": "step-ratios",
}
"""Names of options on the command line that differ from the names of the arguments."""


def kept_box_search(search: BoxSearch, case: str, free: Mapping[str, int]) -> BoxSearch:
    """Return a search that retains the parts of a case.

    Parameters
    ----------
    search : BoxSearch
        Search that the other options define.
    case : str
        File of the case.
    free : mapping
        Largest number of missing parts, from `free_parts`.

    Raises
    ------
    ReadError
        If the case cannot be read, or is not a gearbox of planetary sets.
    UsageError
        If an option is given whose value follows from the case.
    """
    from vstatics.synthesis.boxes.modified import kept_search

    for name in OF_CASE:
        if getattr(search, name):
            option = SPELLED.get(name, name)
            raise click.UsageError(f"--{option} follows from the case of --keep: expected it alone")
    data, file = files.read_input(case)
    reading = read_data(data, file, None, Telling())
    try:
        case_search = kept_search(reading.case, free.get("elements", 0), search.targets)
    except CaseError as error:
        raise ReadError(problem.in_file(file) for problem in error.problems) from None
    names = ("bounds", "tolerance", "tolerances", "sequence")
    from_options = {name: getattr(search, name) for name in names}
    return case_search._replace(elements=search.elements or case_search.elements, **from_options)


def free_parts(texts: Sequence[str]) -> dict[str, int]:
    """Read the largest number of parts that may be missing, by kind; shift elements only.

    >>> free_parts(["shift-elements=2"]), free_parts(["elements=1"])
    ({'elements': 2}, {'elements': 1})
    """
    counts = named("shift-elements=N", _count)(texts)
    for name in counts:
        if name not in ("shift-elements", "elements"):
            raise ValueError(f"read {quoted(name)}, expected shift-elements=N")
    return {"elements": max(counts.values())} if counts else {}


def _count(text: str) -> int:
    count = 0 if text == "0" else typed_number(text, MOST_ELEMENTS)
    if count is None:
        raise ValueError(f"expected a number from 0 to {MOST_ELEMENTS}")
    return count
