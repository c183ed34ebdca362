"""Numbers with units of inertia, stiffness, pressure and other measures, converted to SI."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from functools import cache
from typing import NamedTuple

from vstatics.core.errors import quoted, spoken
from vstatics.core.model.shape import STRAIGHT, UNIT_OF, InUnit, Measure
from vstatics.core.readers.named.arithmetic import ARITHMETIC, UnitError, calculated, slip
from vstatics.core.readers.named.units import (
    LONGEST_UNIT,
    POUND_MASS,
    TRIPLE,
    Quantity,
    factors,
    has_digits,
    plain_unit,
    unit,
    usual,
    with_article,
)
from vstatics.core.suggestions import nearest

WITH_UNIT = rf"^{ARITHMETIC}[*·]? *[1A-Za-zА-я°/(][-A-Za-zА-я°0-9_*·⋅∙×./^() ²³⁴⁻−¹]{{0,39}}$"
"""Regular expression of a number with a unit, for JSON Schema."""

_Dimension = tuple[int, ...]
"""Dimension of a unit: exponents of kg, m, s, rad and K."""

_FORMS: dict[str, tuple[str, ...]] = {
    "power": ("W",),
    **{measure: (unit,) for measure, unit in UNIT_OF.items()},
    "compliance": ("rad/(N*m)", "1/(N*m)"),
    "damping": ("N*m*s/rad", "N*m*s"),
    "inertia": ("kg*m^2", "kg*m^2/rad"),
    "pump_factor": ("N*m*s^2/rad^2", "N*m*s^2"),
}
"""Units of each measure. The radian can be omitted if the unit stays unambiguous."""


class _Base(NamedTuple):
    dimension: _Dimension
    above: float
    below: float = 1.0
    """Divisor of `above`. The factor from the unit to SI is ``above/below``."""


_NOTHING: _Dimension = (99, 99, 99, 99, 99)
_FLYWHEEL_EFFECT: _Dimension = (1, 3, -2, 0, 0)
"""Dimension of a weight times the square of a diameter, which some catalogues give as inertia."""
_MASS, _TIME = (1, 0, 0, 0, 0), (0, 0, 1, 0, 0)
_BASES: dict[str, tuple[_Dimension, float]] = {
    "force": ((1, 1, -2, 0, 0), 1),
    "length": ((0, 1, 0, 0, 0), 1),
    "angle": ((0, 0, 0, 1, 0), 2 * math.pi),
    "time": ((0, 0, 1, 0, 0), 60),
    "speed": ((0, 0, -1, 1, 0), math.pi / 30),
    "power": ((1, 2, -3, 0, 0), 1000),
}
"""For each kind of factor in `units`: dimension, and factor to SI from the unit used there."""
_STANDARD_GRAVITY = 9.80665
_GRAMS = {
    "g": _Base(_MASS, 1, 1000),
    "г": _Base(_MASS, 1, 1000),
    "kg": _Base(_MASS, 1),
    "кг": _Base(_MASS, 1),
    "t": _Base(_MASS, 1000),
    "т": _Base(_MASS, 1000),
    "kilogram": _Base(_MASS, 1),
    "gram": _Base(_MASS, 1, 1000),
    **dict.fromkeys(
        ("slug", "slugs"), _Base(_MASS, 45359237 * 980665, 10**8 * 30480)
    ),  # lbf*s^2/ft
}
_OTHERS = {
    "K": _Base((0, 0, 0, 0, 1), 1),
    "J": _Base((1, 2, -2, 0, 0), 1),
    "kJ": _Base((1, 2, -2, 0, 0), 1000),
} | {
    word: _Base((1, -1, -2, 0, 0), above, below)
    for words, above, below in (
        ("Pa Па", 1, 1),
        ("hPa гПа mbar мбар", 100, 1),
        ("kPa кПа", 1000, 1),
        ("MPa МПа", 10**6, 1),
        ("bar бар", 10**5, 1),
        ("at ат", 980665, 10),  # kgf/cm^2
        ("psi", 45359237 * 980665 * 10**8, 10**8 * 10**5 * 254**2),  # lbf per square inch
        ("ksi", 45359237 * 980665 * 10**11, 10**8 * 10**5 * 254**2),
    )
    for word in words.split()
}
_IN_ANY_LETTERS = {
    "mph": _Base((0, 1, -1, 0, 0), 44704, 10**5),  # a mile of 1609.344 m per hour
    "mps": _Base((0, 1, -1, 0, 0), 1),
    **dict.fromkeys(("kph", "kmh", "kmph"), _Base((0, 1, -1, 0, 0), 10, 36)),
    POUND_MASS: _Base(_MASS, 45359237, 10**8),
    **{word: _OTHERS[word] for word in ("bar", "бар", "psi", "ksi")},
}
"""Units in a single word; upper and lower case are equivalent."""
_POUNDS = frozenset(("lb", "lbs", "pound", "pounds", "oz", "ounce", "ounces"))
"""Units that are forces in `units`, but masses in a measure with a mass."""
_MILLISECONDS = frozenset(("ms", "msec", "мс"))
"""Units that are metres per second in `units`, but milliseconds in a measure of time."""
_QUANTITIES: dict[Measure, Quantity] = {"si_speed": "speed", "si_torque": "torque"}
"""Measures for which `units` accepts further spellings."""
_TOKEN = re.compile(r" *(?:([*·.×⋅∙/()-]|1(?= */))|([^\W\d_]+|°))")
_EXPONENT = re.compile(r"(?:\^|\*\*)?(\()?(-?[1-4])(?(1)\))(?![0-9])")
_LARGEST_EXPONENT = 4
_USUAL: dict[Measure, str] = {
    "length": "m mm cm km in ft",
    "mass": "kg g t lb",
    "inertia": "kg*m^2 kg*cm^2 kg*mm^2 g*cm^2 lb*ft^2",
    "stiffness": "N*m/rad kN*m/rad N*m/deg",
    "time": "s ms min h",
    "angle": "rad deg mrad",
    "area": "m^2 cm^2 mm^2",
    "pressure": "Pa bar kPa MPa psi",
    "stress": "Pa MPa N/mm^2",
    "velocity": "m/s km/h mph",
    "force": "N kN lbf",
    "straight_stiffness": "N/m N/mm kN/m",
}
"""Units that hints suggest, by measure; only the unit in SI for other measures."""
_SUPERSCRIPTS = str.maketrans("²³⁴⁻−¹", "234--1")


def measured(text: str, measure: Measure, *, units: Sequence[str] = ()) -> float:
    """Return the value in SI of a number with or without a unit.

    If `units` are given, messages say that the number needs a unit such as these.

    Raises
    ------
    ValueError
        The message states the expectation.

    Examples
    --------
    >>> measured("84e-5", "compliance"), measured("150 kg*cm^2", "inertia")
    (0.00084, 0.015)
    >>> measured("1 N*m/deg", "stiffness"), measured("2 rad/(kN*m)", "compliance")
    (57.2957..., 0.002)
    >>> measured("30 1/min", "si_speed") == measured("30 rpm", "si_speed")
    True
    >>> measured("10 mph", "velocity"), measured("10 mi/h", "velocity").__round__(12)
    (4.4704, 4.4704)
    """
    unit = UNIT_OF[measure]
    form = f"in {unit}, bare or with its unit"
    if units:
        form = f"with its unit, such as {spoken(map(quoted, units), 'or')}"
    in_unit = f"expected {with_article(measure)} {form}"
    if not has_digits(text):
        raise ValueError(in_unit)
    value, behind = calculated(text)
    if not behind:
        return value
    for of_words in (True, False):
        dimension, above, below = _unit(behind, of_words=of_words)
        if dimension in _dimensions()[measure]:
            value = value * above / below
            if not math.isfinite(value):
                raise ValueError(f"expected {with_article(measure)} that is smaller")
            return value
    other = {forms[0]: kind for kind, forms in _dimensions().items()}.get(dimension)
    if other:
        raise UnitError(f"{in_unit}; this is {with_article(other)}")
    if measure == "inertia" and dimension == _FLYWHEEL_EFFECT:
        raise UnitError(f"{in_unit}; write a flywheel effect (GD^2) of 4 kgf*m^2 as 1 kg*m^2")
    raise UnitError(in_unit + _hint(text, behind, [measure]))


def _hint(text: str, behind: str, measures: Sequence[Measure]) -> str:
    """Return a hint with the usual unit most similar to an unknown unit, or an empty text."""
    hint = slip(text) or usual(behind, _QUANTITIES.get(measures[0]))
    units = [unit for kind in measures for unit in _USUAL.get(kind, UNIT_OF[kind]).split()]
    return hint or nearest(behind[:LONGEST_UNIT], units)


def in_any_unit(text: str, measures: Sequence[Measure]) -> InUnit:
    """Return the value in SI of a number without a unit, or with a unit of any of `measures`.

    Raises
    ------
    ValueError
        The message states the expectation.

    Examples
    --------
    >>> in_any_unit("4 bar", ["si_torque", "pressure"]).measure, in_any_unit("4", ["time"]).measure
    ('pressure', None)
    """
    units = spoken((UNIT_OF[measure] for measure in measures), "or")
    fault = f"expected a number in {units}, bare or with its unit"
    for measure in measures:
        try:
            value = measured(text, measure)
        except ValueError as error:
            _, mark, hint = str(error).partition("; did you mean")
            if len(measures) == 1:
                fault = str(error)
            elif mark not in fault:
                fault += mark + hint
            continue
        return InUnit(value, measure if calculated(text).behind else None)
    raise UnitError(fault) if has_digits(text) else ValueError(fault)


def of_either(text: str, measure: Measure) -> InUnit:
    """Return the value in SI of a number with a unit of rotation or of motion along a line.

    Raises
    ------
    ValueError
        The message states the expectation.

    Examples
    --------
    >>> of_either("184 N/mm", "stiffness").measure
    'straight_stiffness'
    """
    try:
        return in_any_unit(text, (measure,))
    except ValueError as error:
        try:
            return in_any_unit(text, (STRAIGHT[measure],))
        except ValueError:
            raise error from None


@cache
def _dimensions() -> dict[str, list[_Dimension]]:
    """Return the possible dimensions of each measure; the first is its main dimension."""
    return {
        kind: [_unit(form, of_words=False)[0] for form in forms] for kind, forms in _FORMS.items()
    }


def _unit(text: str, *, of_words: bool) -> tuple[_Dimension, float, float]:
    """Return the dimension of a unit (`_NOTHING` if unknown), and dividend and divisor to SI.

    Parameters
    ----------
    text : str
    of_words : bool
        True if ``lb`` is a mass and ``ms`` a time. False if ``lb`` is a force and ``ms`` a metre
        per second.
    """
    total, above, below = [0] * 5, 1.0, 1.0
    try:
        for word, exponent in _powers(plain_unit(text.translate(_SUPERSCRIPTS))):
            for place, base in enumerate(_bases(word, of_words=of_words)):
                times = exponent if place == 0 else math.copysign(1, exponent)
                total = [a + int(times) * b for a, b in zip(total, base.dimension, strict=True)]
                up, down = (base.above, base.below)[:: 1 if times > 0 else -1]
                above, below = above * up ** abs(times), below * down ** abs(times)
    except (ValueError, OverflowError, ZeroDivisionError):
        return _NOTHING, 1.0, 1.0
    if total == [0, 0, -1, 0, 0] and unit(text)[0] == "speed":  # 1/min is rpm, as in `units`
        return _unit("rpm", of_words=of_words)
    return tuple(total), above, below


def _powers(text: str) -> list[tuple[str, int]]:
    """Return the words of a unit with exponents; a `/` divides by the whole bracket.

    >>> _powers("N*m/(rad/s)^2")
    [('N', 1), ('m', 1), ('rad', -2), ('s', 2)]
    """
    if len(text) > LONGEST_UNIT:
        raise ValueError
    words: list[tuple[str, int]] = []
    starts: list[int] = []
    at, signs, sign = 0, [1], 1
    while at < len(text):
        token = _TOKEN.match(text, at)
        if not token:
            raise ValueError
        at = token.end()
        power = _EXPONENT.match(text, at) if token[1] in (None, ")") else None
        at, exponent = (power.end(), int(power[2])) if power else (at, 1)
        match token[1]:
            case "/":
                sign = -1
            case "(":
                signs.append(signs[-1] * sign)
                starts.append(len(words))
                sign = 1
            case ")":
                if not starts:
                    raise ValueError
                signs.pop()
                start = starts.pop()
                words[start:] = [(word, exponent * inner) for word, inner in words[start:]]
                sign = 1
            case None:
                words.append((token[2], signs[-1] * sign * exponent))
                sign = 1
    if starts or any(abs(exponent) > _LARGEST_EXPONENT for _, exponent in words):
        raise ValueError
    return words


def _bases(word: str, *, of_words: bool) -> list[_Base]:
    """Return the factors of a word, last first; only the last can have an exponent."""
    if of_words and word.casefold() in _POUNDS:
        [(_, above, below)] = factors(word)
        return [_Base(_MASS, above / _STANDARD_GRAVITY, below)]
    if of_words and word in _MILLISECONDS:
        return [_Base(_TIME, 1, 1000)]
    if known := _OTHERS.get(word) or _IN_ANY_LETTERS.get(word.casefold()):
        return [known]
    whole = factors(word)
    if not _known(whole) and not TRIPLE.search(word):
        for end in range(len(word), 0, -1):
            head, tail = word[:end], word[end:]
            tail_factors = factors(tail) if tail else []
            if not _known(tail_factors):
                continue
            if head in _GRAMS:
                return [*map(_base, reversed(tail_factors)), _GRAMS[head]]
            if _known(factors(head)):
                whole = [*factors(head), *tail_factors]
                break
    return list(map(_base, reversed(whole)))


def _known(parts: Sequence[tuple[str, float, float]]) -> bool:
    return all(kind != "?" for kind, _, _ in parts)


def _base(factor: tuple[str, float, float]) -> _Base:
    kind, above, below = factor
    dimension, times = _BASES.get(kind, (_NOTHING, 1.0))
    if (below / times).is_integer():  # so that factors such as those of rad, s and W are exactly 1
        return _Base(dimension, above, below / times)
    return _Base(dimension, above * times, below)
