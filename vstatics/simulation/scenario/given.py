"""Values of a scenario's document before its case settles their units.

Numbers carry their unit, since the expected measure can depend on the case: a pressure where a
shift element has friction, a velocity where a link has a road. `values` builds the parts of a
scenario from these values.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from functools import partial
from typing import Any, NamedTuple, get_args

from vstatics.core.errors import ReadError, quoted, spoken
from vstatics.core.model.shape import UNIT_OF, Measure, Parsed
from vstatics.core.readers.expressions.excerpt import Excerpt
from vstatics.core.readers.named.arithmetic import calculated
from vstatics.core.readers.named.si_units import in_any_unit
from vstatics.simulation.scenario.conditions import StepCondition, read_condition
from vstatics.simulation.scenario.formula import (
    OF_MOTION,
    OF_TORQUES,
    Formula,
    Vocabulary,
    read_formula,
)
from vstatics.simulation.scenario.laws import Road


class GivenControl(NamedTuple):
    """Control of a shift element that is given as a mapping."""

    points: Sequence[tuple[float, float]] | None = None
    formula: float | Formula | None = None
    scale: float = 1.0
    dog: Sequence[tuple[float, str]] | None = None


class GivenLaw(NamedTuple):
    """Law of an outside torque that is given as a mapping."""

    over: str = "time"
    points: Sequence[tuple[float, float]] | None = None
    formula: float | Formula | None = None
    resistance: float | None = None
    road: Road | None = None


def exactly_one(*names: str, with_points: Sequence[str] = ()) -> Callable[..., str]:
    """Return a check that a single key is given, and some keys only with `points`."""

    def fault(**values: Any) -> str:
        given = [name for name in names if values.get(name) is not None]
        if len(given) != 1:
            read = f"read {spoken(map(quoted, given))}" if given else "read none of them"
            return f"{read}, expected one of {spoken(map(quoted, names), 'or')}"
        others = [name for name in with_points if values.get(name) is not None]
        if others and given != ["points"]:
            return f"read {quoted(others[0])} beside {quoted(given[0])}, expected it with `points`"
        return ""

    return fault


class GivenTable(NamedTuple):
    """Table of formulas that is given as a mapping."""

    file: str = ""
    columns: Sequence[float] = ()
    rows: Sequence[Sequence[float]] = ()


class GivenSteps(NamedTuple):
    """Steps of a sequence that are given as a mapping."""

    steps: Sequence[Mapping[str, Any]] = ()
    repeat: bool = False


def _curve(
    text: str, measures: Sequence[Measure], names: Sequence[str], words: Vocabulary
) -> float | Formula:
    """Read a number, bare or with a unit, or a formula: `t` in ``3*t`` is time, not tonnes."""
    try:
        behind = calculated(text).behind
    except ValueError:
        behind = "*"
    if not behind or behind[0].isalpha() or behind[0] == "°":
        return in_any_unit(text, measures)
    try:
        return read_formula(Excerpt(text, ""), names, words)
    except ReadError:
        with suppress(ValueError):
            return in_any_unit(text, measures)
        raise


def _number(measures: Sequence[Measure], expected: str, unit: str = "") -> Parsed:
    return Parsed(expected, partial(in_any_unit, measures=measures), 0.0, unit)


ANY_MEASURE = get_args(Measure)
_TORQUE, _SPEED = UNIT_OF["si_torque"], UNIT_OF["si_speed"]
CAPACITY = _number(["si_torque", "pressure"], "a capacity in N*m, or a pressure in Pa", _TORQUE)
ABSCISSA = _number(
    ["time", "si_speed", "angle", "velocity", "length"], "a time, a speed, an angle or a way"
)
SPEED = _number(["si_speed", "velocity"], "a speed", _SPEED)
TWIST = _number(["angle", "length"], "an angle in rad, or a length in m", UNIT_OF["angle"])
ANYTHING = _number(ANY_MEASURE, "a number")


def capacity_curve(words: Vocabulary) -> Parsed:
    """Return the shape of a capacity, over time or by a formula of the motion."""
    measures: Sequence[Measure] = ["si_torque", "pressure"]
    parse = partial(_curve, measures=measures, names=["t"], words=words.only(*OF_MOTION))
    return Parsed("a capacity, or a formula of t", parse, 0.0, _TORQUE)


def torque_curve(words: Vocabulary) -> Parsed:
    """Return the shape of a torque on a link, over time or by a formula of the motion."""
    names, seen = ["t", "speed", "angle"], words.only(*OF_MOTION)
    parse = partial(_curve, measures=["si_torque", "force"], names=names, words=seen)
    return Parsed("a torque, or a formula of t, speed and angle", parse, 0.0, _TORQUE)


def limit_curve(words: Vocabulary) -> Parsed:
    """Return the shape of a torque limit of a spring, over time or by the motion."""
    parse = partial(
        _curve, measures=["si_torque", "force"], names=["t"], words=words.only(*OF_MOTION)
    )
    return Parsed("a torque, or a formula of t", parse, 0.0, _TORQUE)


def speed_curve(words: Vocabulary) -> Parsed:
    """Return the shape of a speed over time."""
    return _timed_curve(words, "a speed", ["si_speed", "velocity"], _SPEED)


def ratio_curve(words: Vocabulary) -> Parsed:
    """Return the shape of a speed ratio over time."""
    return _timed_curve(words, "a speed ratio", ["angle"])


def _timed_curve(
    words: Vocabulary, what: str, measures: Sequence[Measure], unit: str = ""
) -> Parsed:
    seen = words.only()._replace(values=())
    parse = partial(_curve, measures=measures, names=["t"], words=seen)
    return Parsed(f"{what}, or a formula of t", parse, 0.0, unit)


def value_curve(words: Vocabulary) -> Parsed:
    """Return the shape of a number, or of a formula of everything but events."""
    seen = words.only(*OF_MOTION, *OF_TORQUES)
    parse = partial(_curve, measures=ANY_MEASURE, names=["t"], words=seen)
    return Parsed("a number, or a formula", parse, 0.0)


def condition(words: Vocabulary) -> Parsed:
    """Return the shape of a condition of a step."""

    def parse(text: str) -> StepCondition:
        return read_condition(Excerpt(text, ""), words)

    return Parsed("a condition, such as `t >= 0.5`", parse, None)
