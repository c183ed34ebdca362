"""`vstatics synth box --keep`: boxes that differ from a case by a few of their elements."""

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
"""What the case tells, and no option beside it."""


def kept_box_search(search: BoxSearch, case: str, free: Mapping[str, int]) -> BoxSearch:
    """A search that has what a case has, and what is left to be asked.

    Parameters
    ----------
    search : BoxSearch
        As the options say it.
    case : str
        Its file.
    free : mapping
        As `free_parts` reads it.

    Raises
    ------
    ReadError
        If there is no such case, or it is no gearbox of planetary sets.
    UsageError
        If an option says what the case tells.
    """
    from vstatics.synthesis.boxes.modified import kept_search

    for name in OF_CASE:
        if getattr(search, name):
            option = name.replace("_", "-")
            raise click.UsageError(f"--{option} is told by the case of --keep: expected it alone")
    data, file = files.read_input(case)
    reading = read_data(data, file, None, Telling())
    try:
        found = kept_search(reading.case, free.get("elements", 0), search.targets)
    except CaseError as error:
        raise ReadError(one.in_file(file) for one in error.problems) from None
    names = ("bounds", "tolerance", "tolerances", "sequence")
    found = found._replace(**{name: getattr(search, name) for name in names})
    return found._replace(elements=search.elements or found.elements)


def free_parts(texts: Sequence[str]) -> dict[str, int]:
    """How many parts of each kind may be others; there are elements only.

    >>> free_parts(["elements=2"])
    {'elements': 2}
    """
    found = named("elements=N", _count)(texts)
    for name in found:
        if name != "elements":
            raise ValueError(f"read {quoted(name)}, expected elements=N")
    return found


def _count(text: str) -> int:
    count = 0 if text == "0" else typed_number(text, MOST_ELEMENTS)
    if count is None:
        raise ValueError(f"expected a number from 0 to {MOST_ELEMENTS}")
    return count
