"""Check of a case or scenario: errors, warnings and notes about its text, model and gears.

>>> case = b"{links: 2, mechanisms: {D: {first: 1, second: 2}}, gears: {1: []}}"
>>> [str(problem) for problem in problems_of(case, "box.yaml")]
['box.yaml:1:25: error: mechanisms.D: `ratio` is missing [E191]']
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence

from vstatics.core import readers
from vstatics.core.arguments import refusing
from vstatics.core.errors import CaseError, Problem, ReadError, not_allowed
from vstatics.core.model.checks import hints
from vstatics.core.readers.kinds import document_function
from vstatics.core.statics.diagnosis.unknown_speeds import undriven_gears
from vstatics.core.statics.solution import solution
from vstatics.core.suggestions import why_not_allowed


@refusing()
def check(
    source: str | os.PathLike[str] | readers.Stream, *, allow: Sequence[str] = ()
) -> list[Problem]:
    r"""Check a case or scenario, and calculate a case; return errors, warnings and notes.

    Parameters
    ----------
    source : path-like or stream
        Deck, YAML, JSON or workbook, or an open stream such as ``io.StringIO(text)``. A stream
        without a name must not refer to files, so that untrusted text cannot open files.
    allow : sequence of str
        Ids of warnings and notes to suppress, in addition to the key `allow` of the case.

    Returns
    -------
    list of Problem
        Problems with `id`, `severity`, `message` and `place`.

    Raises
    ------
    OSError
        If a file cannot be opened.
    ValueError
        If `allow` contains the id of an error or an unknown id.

    Examples
    --------
    >>> import io
    >>> text = "links: 2\nmechanisms: {D: {first: 1, second: 2}}\ngears: {1: []}"
    >>> [problem] = check(io.StringIO(text))
    >>> problem.id, problem.severity, problem.place.line
    ('E191', 'error', 2)
    """
    for why in filter(None, map(why_not_allowed, allow)):
        raise ValueError(why)
    with readers.content(source) as (data, name):
        return not_allowed(problems_of(data, name, allow), allow)


def problems_of(data: bytes, file: str, allow: Sequence[str] = ()) -> list[Problem]:
    """Return all problems in the content of a file, except suppressed messages about gears."""
    try:
        if document_problems := document_function("document_problems", data, file):
            return [*document_problems(data, file)]
        reading = readers.read(data, file).allowing(allow)
    except ReadError as error:
        return error.problems
    try:
        results = solution(reading.case)
    except CaseError as error:
        return [*map(reading.locate, error.problems)]
    messages = reading.located_messages(results, each_gear=True)
    undriven, notes = (
        map(reading.locate, problems) for problems in (undriven_gears(results), hints(reading.case))
    )
    every = causes_first([*undriven, *reading.warnings, *notes, *messages])
    return not_allowed(every, reading.case.untold)


def causes_first(problems: Iterable[Problem]) -> list[Problem]:
    """Return problems with W102 first: a link without connections causes other problems.

    >>> planets = b"P: {kind: planetary, sun: in, ring: r, carrier: c, teeth: {sun: 30, ring: 70}}"
    >>> case = b"{input: in, output: c, elements: {%b}, gears: {1: []}}" % planets
    >>> [problem.id for problem in problems_of(case, "box.yaml")]
    ['W102', 'E453', 'W414']
    """
    return sorted(problems, key=lambda problem: problem.id != "W102")
