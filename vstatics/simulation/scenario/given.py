"""Values in the document of a scenario, before the case determines their units.

Numbers carry their unit, because the case can determine the expected quantity: a pressure if a
shift element has friction, a velocity if a link has a road. `values` builds a scenario from these
values.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from functools import partial
from typing import Any, NamedTuple, get_args

from vstatics.core.errors import ReadError, quoted, spoken
from vstatics.core.model.shape import UNIT_OF, Measure, Parsed
from vstatics.core.readers.expressions.evaluation import FUNCTIONS
from vstatics.core.readers.expressions.excerpt import Excerpt
from vstatics.core.readers.named.arithmetic import UnitError, calculated, dimensionless
from vstatics.core.readers.named.si_units import in_any_unit
from vstatics.core.readers.named.units import has_digits, quantity
from vstatics.simulation.scenario.conditions import read_condition
from vstatics.simulation.scenario.formula import SHORT_SPEED, Formula, Vocabulary, read_formula
from vstatics.simulation.scenario.laws import Road


class GivenControl(NamedTuple):
    """Control of a shift element, as a mapping in the document."""

    points: Sequence[tuple[float, float]] | None = None
    formula: float | Formula | None = None
    scale: float = 1.0
    dog: Sequence[tuple[float, str]] | None = None


class GivenLaw(NamedTuple):
    """Law of an external torque, as a mapping in the document."""

    over: str = "time"
    points: Sequence[tuple[float, float]] | None = None
    formula: float | Formula | None = None
    resistance: float | None = None
    road: Road | None = None


def exactly_one(*names: str, with_points: Sequence[str] = ()) -> Callable[..., str]:
    """Return a check that exactly one key is present, and some keys only together with `points`."""

    def fault(**values: Any) -> str:
        given = [name for name in names if values.get(name) is not None]
        if len(given) != 1:
            read = f"read {spoken(map(quoted, given))}" if given else "read none of them"
            return f"{read}, expected one of {spoken(map(quoted, names), 'or')}"
        others = [name for name in with_points if values.get(name) is not None]
        if others and given != ["points"]:
            return f"read {quoted(others[0])} with {quoted(given[0])}, expected it with `points`"
        return ""

    return fault


class GivenTable(NamedTuple):
    """Lookup table for formulas, as a mapping in the document."""

    file: str = ""
    columns: Sequence[float] = ()
    rows: Sequence[Sequence[float]] = ()


class GivenSteps(NamedTuple):
    """Steps of a sequence, as a mapping in the document."""

    steps: Sequence[Mapping[str, Any]] = ()
    repeat: bool = False


def _number(measures: Sequence[Measure], expected: str, unit: str = "") -> Parsed:
    return Parsed(expected, partial(in_any_unit, measures=measures), 0.0, unit)


def si_number(text: str) -> float:
    """Return a number in SI units from a number with or without a unit, or a percentage.

    Raises
    ------
    ValueError
        The message states the expectation.

    Examples
    --------
    >>> si_number("2 kN*m"), si_number("80 kW"), si_number("25 %")
    (2000.0, 80000.0, 0.25)
    >>> si_number("3.5 * t")
    Traceback (most recent call last):
    ...
    ValueError: expected a number, not a formula; write a unit as in `3.5 t`
    """
    if product := _PRODUCT.fullmatch(text.strip()):
        unit = " ".join(product.groups())
        raise ValueError(f"expected a number, not a formula; write a unit as in `{unit}`")
    with suppress(ValueError):
        return in_any_unit(text, ANY_MEASURE)
    with suppress(ValueError):
        return 1000 * quantity(text, "power")
    if not has_digits(text):
        raise ValueError(_ANY_NUMBER)
    try:
        return dimensionless(text)
    except ValueError:
        raise UnitError(_ANY_NUMBER) from None


_ANY_NUMBER = "expected a number, with or without a unit such as `N*m`, `kW` or `%`"
_COMPARISONS = frozenset("<>=?")
_PRODUCT = re.compile(r"([-+\d.e]+) *\* *([a-zA-Z])")
"""Pattern of a number times one letter, which is a unit (tonnes) or a variable (time)."""
ANY_MEASURE = get_args(Measure)
TORQUE_UNIT, SPEED_UNIT = UNIT_OF["si_torque"], UNIT_OF["si_speed"]
CAPACITY = _number(["si_torque", "pressure"], "a capacity in N*m, or a pressure in Pa", TORQUE_UNIT)
ABSCISSA = _number(
    ["time", "si_speed", "angle", "velocity", "length"], "a time, a speed, an angle or a way"
)
SPEED = _number(["si_speed", "velocity"], "a speed", SPEED_UNIT)
TWIST = _number(["angle", "length"], "an angle in rad, or a length in m", UNIT_OF["angle"])
SI_NUMBER = Parsed("a number", si_number, 0.0)


def curve(
    expected: str,
    measures: Sequence[Measure],
    words: Vocabulary,
    names: Sequence[str] = ("t",),
    unit: str = "",
) -> Parsed:
    """Return the shape of a value that is a formula, or a number with or without a unit.

    Parameters
    ----------
    measures : sequence of str
        Allowed quantities of a number with a unit, such as `time`.
    words, names
        Names and variables that the formula can use.
    unit : str, optional
        Unit of bare numbers.
    """
    read = si_number if measures is ANY_MEASURE else partial(in_any_unit, measures=measures)

    def parse(text: str) -> float | Formula:
        try:
            behind = calculated(text).behind
        except ValueError:
            behind = "*"
        is_compared = not _COMPARISONS.isdisjoint(behind)  # as in `5 if t < 1 else 0`
        if not behind or ((behind[0].isalpha() or behind[0] == "°") and not is_compared):
            try:
                return read(text)
            except ValueError as error:
                if behind.partition("(")[0].strip() not in (*names, SHORT_SPEED, *FUNCTIONS):
                    raise
                raise UnitError(f"{error}; in a formula, write `*` between factors") from None
        try:
            return read_formula(Excerpt(text, ""), names, words)
        except ReadError:
            with suppress(ValueError):
                return read(text)  # `3 t` is a mass, but `t` in 3*t is the time
            raise

    return Parsed(expected, parse, 0.0, unit)


def condition(words: Vocabulary) -> Parsed:
    """Return the shape of the condition of a sequence step."""
    return Parsed(
        "a condition, such as `t >= 0.5`",
        lambda text: read_condition(Excerpt(text, ""), words),
        None,
    )
