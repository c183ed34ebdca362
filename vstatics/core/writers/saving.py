"""Cases as files of any format, and the parts of a case that a format cannot contain."""

from __future__ import annotations

import os

from vstatics.core.arguments import refusing
from vstatics.core.errors import printable
from vstatics.core.jobs.files import replace
from vstatics.core.model.transmission import Transmission
from vstatics.core.statics.solve import solve
from vstatics.core.tables.file_suffixes import suffix_of

SUFFIXES = {
    ".dat": "deck",
    ".deck": "deck",
    ".yaml": "yaml",
    ".yml": "yaml",
    ".json": "json",
    ".xlsx": "xlsx",
}
"""Formats of case files, by suffix."""


@refusing()
def save(case: Transmission, path: str | os.PathLike[str]) -> list[str]:
    """Write a case to a file, in the format of the suffix.

    The file is written completely or not at all.

    Parameters
    ----------
    case : Transmission
    path : path-like
        File, with the suffix .yaml, .json, .xlsx or .dat (a deck).

    Returns
    -------
    list of str
        Parts of the case that the format cannot contain.

    Raises
    ------
    CaseError
        If parts that the format cannot contain affect the results.
    ValueError
        If the suffix does not belong to a format.
    OSError
        If the file cannot be written.

    Examples
    --------
    >>> import tempfile
    >>> from vstatics import Gear, Mechanism, load
    >>> case = Transmission(2, [], [Mechanism(1, 2, 0, 2.5)], [Gear()], description="a pair")
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     save(case, f"{folder}/pair.dat"), save(case, f"{folder}/pair.yaml")
    ...     load(f"{folder}/pair.yaml") == case
    (['description'], [])
    True
    """
    file = os.fspath(path)
    form = SUFFIXES.get(suffix_of(file))
    if form is None:
        raise ValueError(f"{file}: expected one of the suffixes {', '.join(SUFFIXES)}")
    data, lost = case_data(case, form)
    replace(file, data)
    return lost


def case_data(case: Transmission, form: str) -> tuple[bytes, list[str]]:
    """Return a case as the bytes of a file, and the parts that the format cannot contain.

    Raises
    ------
    CaseError
        If the case would have other results without these parts.
    """
    lost: list[str] = []
    if form == "xlsx":
        from vstatics.core.writers import workbook

        return workbook.write(case), lost
    if form == "deck":
        from vstatics.core.writers import deck
        from vstatics.core.writers.deck_limits import check_deck

        check_deck(case)
        results = solve(case)
        text = deck.write(results.with_numbers_only)
        lost = deck.lost(case)
        lost += [
            f"that gear {gear.name} is in conflict: a deck does without the freewheel"
            for gear, is_in_conflict in zip(case.gears, results.conflict.tolist(), strict=True)
            if is_in_conflict
        ]
    elif form == "matrices":
        from vstatics.core.writers import matrices

        text = matrices.write(case)
    else:
        from vstatics.core.writers import named

        text = named.write_yaml(case) if form == "yaml" else named.write_json(case)
    return printable(text, lines=True).encode(), lost
