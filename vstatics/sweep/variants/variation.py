"""Parser of --vary: a varied number and its values."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple, Protocol, TypeAlias, runtime_checkable

import numpy as np

from vstatics.core.errors import Place, Problem, ReadError
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.steps import Steps, stepped
from vstatics.core.readers.named.nodes import MOST_PROBLEMS
from vstatics.core.readers.named.scalars import number as finite_number
from vstatics.core.readers.named.units import common_unit
from vstatics.sweep.variants.path_numbers import CasePath
from vstatics.sweep.variants.subject import VariedSubject, target_of
from vstatics.sweep.variants.targets import NAMES, Target, Varied, behind, refusal, shown

OPTION = "--vary"
MOST = 2**63 - 1
"""Largest number of values, and of variants."""
FORMS = "START:STOP:COUNT, START:STOP:step=STEP or a list such as 0.95,0.97"

_ASSIGNED = re.compile(rf"(.*?\.(?:{'|'.join(NAMES)})\s*)=")
_UNQUOTED = re.compile(r"(?:\"[^\"]*\"|'[^']*'|[^\"'=])*")
_STEP = re.compile(r"\s*step\s*=\s*")
_COUNT = re.compile(r"[0-9]{1,19}")
_DOTS = ".."
"""Range operator of other programs, recognised for a hint and never part of a number."""
_NO_NUMBER = ("nan", "inf", "infinity")


class Span(NamedTuple):
    """Range of numbers between two bounds, from which only samples can be drawn."""

    low: float
    high: float


@runtime_checkable
class DrawnNumbers(Protocol):
    """Distribution of a number, from which only samples can be drawn."""

    def quantiles(self, parts: Floats) -> Floats:
        """Return the quantiles of the distribution at the fractions `parts`."""


Values: TypeAlias = Floats | Steps | Span | DrawnNumbers
"""List of values, equal steps (with `len` and indexing), or a range or distribution to sample."""


class Variation(NamedTuple):
    """Varied number and its values."""

    target: Varied
    values: Values
    place: Place | None = None
    """Place of the text, for messages."""


def read_variation(text: str, subject: VariedSubject, place: Place | None = None) -> Variation:
    """Parse a varied number and its values.

    Parameters
    ----------
    text : str
        `D1.ratio=` and one of
        `-0.9:-0.7:201` (start, stop and count; both ends included),
        `-0.9:-0.7:step=0.001` (the end is included if a step hits it),
        `0.95,0.97,-96/39` (a list),
        `-0.9:-0.7` (any number between, for samples).
    subject : Transmission or VariedScenario
    place : Place, optional
        Place of the text, for messages; by default the option `--vary`.

    Raises
    ------
    ReadError
        If the text is invalid, with the place of the error. Impossible ratios or efficiencies are
        accepted here; their variants get the status ``invalid``.

    Examples
    --------
    >>> from vstatics.core.model.transmission import Gear, Mechanism, Transmission
    >>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear()])
    >>> read_variation("D1.ratio=-3:-2:5", case).values
    Steps(start=-3.0, stop=-2.0, number=5)
    >>> read_variation("D1.efficiency=0.95,0.97", case).values
    array([0.95, 0.97])
    """
    place = place or Place(OPTION, 1, 1, text)
    varied, end = _read_name(text, subject, place, FORMS)
    begin, values = behind(place, end + 1), text[end + 1 :]
    if not values.strip():
        raise refusal(f"read no values, expected {FORMS}", begin)
    if _DOTS in values:
        start, _, stop = map(str.strip, values.partition(_DOTS))
        hint = f"; such as `{start}:{stop}:50`" if start and stop else ""
        message = f"read {shown(values)}, expected {FORMS}{hint}"
        raise refusal(message, begin, len(values) - len(values.lstrip()))
    try:
        values, unit = (values, "") if isinstance(varied, Target) else common_unit(values)
        read = _range(values, begin) if ":" in values else _list(values, begin)
        if isinstance(varied, CasePath):
            varied = varied.in_unit(unit)
    except ValueError as error:
        raise refusal(str(error), begin) from None
    if not isinstance(subject, Transmission):
        varied = subject.in_unit(varied, unit, begin)
    return Variation(varied, read, place)


def _read_name(
    text: str, subject: VariedSubject, place: Place, expected: str
) -> tuple[Varied, int]:
    """Return the number named before `=`, and the position of `=` in the text."""
    end = _assigned(text, subject)
    if end < 0:
        name = target_of(text, subject, place).name
        message = f"read {shown(text)} without values, expected {name}= and then {expected}"
        raise refusal(message, place, len(text.rstrip()))
    return target_of(text[:end], subject, place), end


def read_linked(text: str, subject: VariedSubject, place: Place) -> tuple[Varied, int]:
    """Parse the name of a linked number, and return the number and the position of `=`.

    Raises
    ------
    ReadError
        If the number does not exist, or its unit is missing.

    Examples
    --------
    >>> from vstatics.core.model.transmission import Gear, Mechanism, Transmission
    >>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear()])
    >>> target, end = read_linked("D1.ratio=2 - D1.efficiency", case, Place("--with", 1, 1))
    >>> target.name, end
    ('D1.ratio', 8)
    """
    varied, end = _read_name(text, subject, place, "a formula of other numbers")
    if isinstance(varied, CasePath):
        varied = _in_brackets(varied, place)
    if not isinstance(subject, Transmission):
        varied = subject.in_unit(varied, "", place)
    return varied, end


def _in_brackets(path: CasePath, place: Place) -> CasePath:
    """Return a number whose values have the unit given in brackets."""
    try:
        return path.in_unit("")
    except ValueError as error:
        hint = ""
        if path.measure:
            unit = path.example.split()[-1]
            hint = f"; write the unit in brackets, such as `{path.path} [{unit}]=...`"
        raise refusal(f"{error}{hint}", place) from None


def _assigned(text: str, subject: VariedSubject) -> int:
    """Return the position of the `=` after a name; -1 if missing."""
    if isinstance(subject, Transmission):
        assigned = _ASSIGNED.match(text)
        return assigned.end(1) if assigned else text.find("=")
    end = _UNQUOTED.match(text)
    return end.end() if end and end.end() < len(text) else -1


def read_value(text: str) -> float:
    """Parse a number or a fraction; nan and inf are accepted, and make a variant invalid.

    Raises
    ------
    ValueError
        If the text is not a number; the message says what was expected.

    Examples
    --------
    >>> read_value("-96/39") == -96 / 39, read_value("nan")
    (True, nan)
    """
    if text.lower().lstrip("+-") in _NO_NUMBER and text[1:2] not in ("+", "-"):
        return float(text)
    return finite_number(text)


def _list(text: str, place: Place | None) -> Floats:
    values, problems = [], []
    for offset, cell in _cells(text, ","):
        try:
            values.append(read_value(cell))
        except ValueError as error:
            message = f"read {shown(cell)}, {error}"
            problems.append(Problem("E718", message, place=behind(place, offset)))
            if len(problems) >= MOST_PROBLEMS:
                break
    if problems:
        raise ReadError(problems)
    return np.array(values)


def _range(text: str, place: Place | None) -> Steps | Span:
    cells = list(_cells(text, ":"))
    if len(cells) > 3:
        raise refusal(f"read a fourth part, expected {FORMS}", place, cells[3][0])
    start, stop = (_end(cell, behind(place, offset)) for offset, cell in cells[:2])
    if len(cells) == 2:
        return Span(min(start, stop), max(start, stop))
    offset, cell = cells[2]
    third = behind(place, offset)
    step = _STEP.match(cell)
    if step:
        return _steps(start, stop, cell[step.end() :], behind(third, step.end()))
    return _counted(start, stop, cell, third)


def _end(text: str, place: Place | None) -> float:
    try:
        return finite_number(text)
    except ValueError as error:
        raise refusal(f"read {shown(text)}, {error}", place) from None


def _counted(start: float, stop: float, text: str, place: Place | None) -> Steps:
    if not _COUNT.fullmatch(text) or int(text) > MOST:
        expected = "how many values, such as 201, or a step, such as step=0.001"
        raise refusal(f"read {shown(text)}, expected {expected}", place)
    count = int(text)
    if count < (1 if start == stop else 2):
        message = f"read {count}, expected at least 2 values: both ends are included"
        raise refusal(message, place)
    return Steps(start, stop, count)


def _steps(start: float, stop: float, text: str, place: Place | None) -> Steps:
    step = _end(text, place)
    steps = stepped(start, stop, step)
    if steps is None:
        expected = "a step other than 0" if step == 0 else f"step={-step:g}"
        message = f"a step of {step:g} does not lead from {start:g} to {stop:g}"
        raise refusal(f"{message}, expected {expected}", place)
    if steps.number > MOST:
        raise refusal(f"read {shown(text)}, expected a larger step: below 2**63 values", place)
    return steps


def _cells(text: str, separator: str) -> Iterator[tuple[int, str]]:
    """Yield the parts of a text between separators, without blanks, with the offsets."""
    offset = 0
    for part in text.split(separator):
        blanks = len(part) - len(part.lstrip()) if part.strip() else 0
        yield offset + blanks, part.strip()
        offset += len(part) + len(separator)
