"""What is wrong or doubtful about a case or a scenario: problems of its text, its model, its gears.

>>> case = b"{links: 2, mechanisms: {D: {first: 1, second: 2}}, gears: {1: []}}"
>>> [str(one) for one in problems_of(case, "box.yaml")]
['box.yaml:1:25: error: mechanisms.D: `ratio` is missing [E191]']
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence

from vstatics.core import readers
from vstatics.core.arguments import refusing
from vstatics.core.errors import CaseError, Problem, ReadError, not_allowed, plural, spoken
from vstatics.core.model.checks import hints
from vstatics.core.readers.kinds import document_function
from vstatics.core.readers.reading import Reading
from vstatics.core.statics.result_arrays import Message
from vstatics.core.statics.results import Results
from vstatics.core.statics.solve import solve
from vstatics.core.suggestions import why_not_allowed


@refusing()
def check(
    source: str | os.PathLike[str] | readers.Stream, *, allow: Sequence[str] = ()
) -> list[Problem]:
    r"""All problems, warnings and notes of a case or a scenario; a case is calculated for that.

    Parameters
    ----------
    source : path-like or stream
        A deck, YAML, JSON or a workbook; or something opened, such as ``io.StringIO(text)``. Files
        that a stream without a name names are refused, so that a text of a stranger opens none.
    allow : sequence of str
        Ids of warnings and notes that are not told, besides those that the case allows.

    Returns
    -------
    list of Problem
        With `id`, `severity`, `message` and `place`; none where all is well. What the case
        allows is not told.

    Raises
    ------
    OSError
        If a file cannot be opened.
    ValueError
        If an id to be allowed is of an error, or of nothing.

    Examples
    --------
    >>> import io
    >>> text = "links: 2\nmechanisms: {D: {first: 1, second: 2}}\ngears: {1: []}"
    >>> [(one.id, one.severity, one.place.line) for one in check(io.StringIO(text))]
    [('E191', 'error', 2)]
    """
    for why in filter(None, map(why_not_allowed, allow)):
        raise ValueError(why)
    with readers.content(source) as (data, name):
        return not_allowed(problems_of(data, name), allow)


def problems_of(data: bytes, file: str) -> list[Problem]:
    """The same of what a file holds."""
    try:
        if document_problems := document_function("document_problems", data, file):
            return [*document_problems(data, file)]
        reading = readers.read(data, file)
        results = _solved(reading)
    except ReadError as error:
        return error.problems
    found = located_messages(reading, results, each_gear=True)
    notes = map(reading.locate, hints(reading.case))
    return not_allowed([*reading.warnings, *notes, *found], reading.case.untold)


def _solved(reading: Reading) -> Results:
    """The results of a case, or why there are none, with its place."""
    try:
        return solve(reading.case)
    except CaseError as error:
        raise ReadError(map(reading.locate, error.problems)) from None


def located_messages(reading: Reading, results: Results, *, each_gear: bool) -> Iterator[Problem]:
    """The messages of a result as problems: at the place of each gear, or of the first of many."""
    if not results.messages:
        return
    numbers = {gear.name: number for number, gear in enumerate(results.case.gears, 1)}
    together: dict[object, list[Message]] = {}
    for message in results.messages:
        if message.gear:
            key = message if each_gear else message._replace(gear="")
            together.setdefault(key, []).append(message)
    for first, *others in together.values():
        place = reading.locate(Problem(first.id, "", ("gears", numbers[first.gear]))).place
        names = spoken([first.gear, *(other.gear for other in others)])
        text = f"{plural('gear', 1 + len(others))} {names}: {first.text}"
        yield Problem(first.id, text, place=place)
