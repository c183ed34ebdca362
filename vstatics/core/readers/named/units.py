"""Units of speed, torque and power in common use, and numbers with a unit."""

from __future__ import annotations

import math
import re
from typing import Literal, Self

from vstatics.core.model.shape import UNITS
from vstatics.core.readers.named.arithmetic import (
    ARITHMETIC,
    UnitError,
    calculated,
    dimensionless,
    expected,
    further,
    slip,
)
from vstatics.core.suggestions import mixed_letters, nearest

Quantity = Literal["speed", "torque", "power"]

_Factor = tuple[str, int, float]
"""Kind of a unit, and numerator and denominator of its size in N, m, turns, min or kW."""
_LB, _FT, _G = (45359237, 10**8), (3048, 10**4), (980665, 10**5)
"""Numerator and denominator of the pound in kg, the foot in m (International Yard and Pound,
1959) and standard gravity in m/s^2
(3rd CGPM, 1901). All values are exact."""
_LBF = (_LB[0] * _G[0], _LB[1] * _G[1])

_PREFIXED: dict[str, _Factor] = {
    **dict.fromkeys(("N", "Н", "newton", "newtons"), ("force", 1, 1)),
    **dict.fromkeys(("m", "м", "meter", "meters", "metre", "metres"), ("length", 1, 1)),
    **dict.fromkeys(("W", "Вт", "watt", "watts"), ("power", 1, 1000)),
}
"""Units that can have a metric prefix. Upper and lower case differ."""
_PREFIXES = {
    prefix: (above, below)
    for prefixes, above, below in (
        ("M М mega", 10**6, 1),
        ("k к kilo", 1000, 1),
        ("da да deca", 10, 1),
        ("d д deci", 1, 10),
        ("c с centi", 1, 100),
        ("m м milli", 1, 1000),
    )
    for prefix in prefixes.split()
} | {"": (1, 1)}
_WORDS_OF_UNITS: dict[str, _Factor] = {
    word: (kind, above, below)
    for words, kind, above, below in (
        ("lb lbs lbf pound pounds", "force", *_LBF),
        ("oz ozf ounce ounces", "force", _LBF[0], _LBF[1] * 16),
        ("kip kips", "force", _LBF[0] * 1000, _LBF[1]),
        ("kgf kp kilopond кгс", "force", *_G),
        ("gf pond гс", "force", _G[0], _G[1] * 1000),
        ("tf тс", "force", _G[0] * 1000, _G[1]),
        ("dyn dyne", "force", 1, 10**5),
        ("ft foot feet", "length", *_FT),
        ("in inch inches", "length", _FT[0], _FT[1] * 12),
        ("yd yard yards", "length", _FT[0] * 3, _FT[1]),
        ("mi mile miles", "length", _FT[0] * 5280, _FT[1]),
        ("rev revs revolution revolutions turn turns cycle cycles r u umdr tr об", "angle", 1, 1),
        ("rotation rotations", "angle", 1, 1),
        ("rad radian radians рад", "angle", 1, 2 * math.pi),
        ("deg degree degrees ° град", "angle", 1, 360),
        ("arcmin arcminute arcminutes", "angle", 1, 360 * 60),
        ("arcsec arcsecond arcseconds", "angle", 1, 360 * 3600),
        ("mrad milliradian milliradians мрад", "angle", 1, 2000 * math.pi),
        ("min mins minute minutes мин", "time", 1, 1),
        ("s sec secs second seconds с сек", "time", 1, 60),
        ("h hr hour hours ч", "time", 60, 1),
        ("rpm", "speed", 1, 1),
        ("rps", "speed", 60, 1),
        ("krpm", "speed", 1000, 1),
        # SAE J245; DIN 66036
        ("hp bhp horsepower", "power", 550 * _LBF[0] * _FT[0], _LBF[1] * _FT[1] * 1000),
        ("ps cv ch лс", "power", 75 * _G[0], _G[1] * 1000),
    )
    for word in words.split()
}
"""Units without metric prefixes. Upper and lower case are equivalent."""

_KINDS: dict[str, tuple[Quantity, int]] = {
    "speed": ("speed", 1),
    "/time angle": ("speed", 1),
    "force length": ("torque", 1),
    "power": ("power", 1),
    "/time force length": ("power", 60_000),  # N*m/min
}
"""Quantity of each product of units, and divisor to rpm, N*m or kW."""

_SIGNS = str.maketrans("·⋅∙×⁻−¹", "****--1")
_SPELLED = (
    (re.compile(r"_per_| per "), "/"),
    (re.compile(r"force_pound|pound_force"), "lbf"),
    (re.compile(r"metric_horsepower"), "PS"),
    (re.compile(r"(?<=[^\W\d_])_(?=[^\W\d_])"), "*"),
    (re.compile(r" *\*\* *"), "^"),
)
"""Spellings of units in words, as pint prints them, and what `unit` reads."""
_FACTOR = re.compile(r" *([*./-]?) *(1(?= */)|[^\W\d_]+|°)(?:(?:\^|\*\*)?(-?1)(?![0-9]))?")
POUND_MASS = "lbm"
"""Pound as a mass, not the product of a pound and a metre."""
TRIPLE = re.compile(r"(\w)\1\1")
"""Pattern of a letter three times in a row, a typing mistake: `mmm` is not an area."""
LONGEST_UNIT = 40
"""Maximum number of characters of a unit."""


def plain_unit(text: str) -> str:
    """Return a unit with signs instead of words such as `per`.

    >>> plain_unit("revolutions_per_minute"), plain_unit("kilogram * meter ** 2")
    ('revolutions/minute', 'kilogram * meter^2')
    """
    for spelling, sign in _SPELLED:
        text = spelling.sub(sign, text)
    return text


def unit(text: str) -> tuple[Quantity | None, float]:
    """Return quantity and size (in rpm, N*m or kW) of a unit; None for an unknown unit.

    Parameters
    ----------
    text : str
        Unit, whose factors can be separated by `*`, `.`, `-`, a blank, nothing or `/`. Exponents
        can be 1 and -1.

    Examples
    --------
    >>> unit("kNm"), unit("min^-1"), unit("furlong/fortnight")
    (('torque', 1000.0), ('speed', 1.0), (None, 1.0))
    """
    text = plain_unit(text.translate(_SIGNS).replace("л.с.", "лс"))
    kinds = []
    above: float = 1
    below: float = 1
    at = 0
    while at < len(text) <= LONGEST_UNIT:
        factor = _FACTOR.match(text, at)
        if not factor or (at == 0 and factor[1] in ("-", ".")):
            return None, 1.0
        inverse = (factor[1] == "/") != (factor[3] == "-1")
        for kind, up, down in factors(factor[2]):
            kinds += [f"/{kind}" if inverse else kind]
            above, below = (above * down, below * up) if inverse else (above * up, below * down)
        at = factor.end()
    together = " ".join(sorted(kinds))
    if together == "/time" and above == below:  # 1/min is rpm; 1/s could be rad/s
        return "speed", 1.0
    if at < len(text) or together not in _KINDS:
        return None, 1.0
    quantity, divisor = _KINDS[together]
    return quantity, above / (below * divisor)


def factors(word: str) -> list[_Factor]:
    """Split a word into factors: N and m for `Nm`, an unknown factor for `Mm2`."""
    if word == "1":
        return []
    if word.casefold() == POUND_MASS or TRIPLE.search(word):
        return [("?", 1, 1)]
    for end in range(len(word), 0, -1):
        parts = [_factor(part) for part in (word[:end], word[end:]) if part]
        known = [part for part in parts if part]
        if len(known) == len(parts):
            return known
    return [("?", 1, 1)]


def _factor(word: str) -> _Factor | None:
    for prefix, (up, down) in _PREFIXES.items():
        if word.startswith(prefix) and (known := _PREFIXED.get(word[len(prefix) :])):
            kind, above, below = known
            return kind, above * up, below * down
    plain = word.casefold()
    return _WORDS_OF_UNITS.get(plain) or (_PREFIXED.get(plain) if len(plain) > 1 else None)


QUANTITY = rf"^{ARITHMETIC}[*·]? *(1? */ *)?[A-Za-zА-я°][-A-Za-zА-я0-9_*·⋅∙×./^ ⁻−¹]{{0,39}}$"
"""Regular expression of a number with a unit, for JSON Schema."""

EXAMPLES: dict[Quantity, str] = {
    "speed": "`2100 rpm` or `220 rad/s`",
    "torque": "`1200 N*m` or `885 lbf*ft`",
    "power": "`120 kW` or `160 hp`",
}
_USUAL: dict[Quantity, tuple[str, ...]] = {
    "speed": ("rpm", "rad/s", "rev/min", "rev/s", "1/min", "deg/s"),
    "torque": ("N*m", "kN*m", "MN*m", "N*mm", "N*cm", "lbf*ft", "lbf*in", "kgf*m", "kgf*cm"),
    "power": ("kW", "W", "MW", "hp", "PS"),
}
_MEANT = {
    **dict.fromkeys(("1s", "s1", "s", "hz"), "rev/s` or `rad/s"),
    "kgm": "kgf*m",
    "kgcm": "kgf*cm",
}
"""Suggestions for ambiguous or wrong units, by the letters of the unit."""


_MASSES = ("kg", "g", "t", POUND_MASS)
_MEASURES = ("force", "length", "time", "angle")
"""Kinds of units that messages name as a measure."""


def quantity(text: str, kind: Quantity, or_else: str = "") -> float:
    """Return a speed in rpm, a torque in N*m or a power in kW from a text.

    Parameters
    ----------
    text : str
        Number or calculation with its unit.
    kind : {"speed", "torque", "power"}
    or_else : str
        Phrase in the message for an alternative to the quantity.

    Raises
    ------
    ValueError
        The message states the expectation.

    Examples
    --------
    >>> quantity("3000 1/min", "speed"), quantity("1.3*400 Nm", "torque")
    (3000.0, 520.0)
    >>> quantity("100 lbf*ft", "torque"), quantity("75 PS", "power")
    (135.58179483314004, 55.1624062...)
    """
    number, behind = calculated(text) if has_digits(text) else (0.0, "")
    measure, size = unit(behind)
    if measure != kind:
        other = f"; this is a {measure}" if measure else slip(text) or usual(behind, kind)
        if measure == "power":
            other += ", which a `load` can give as `power`"
        error = UnitError if has_digits(text) else ValueError
        raise error(f"expected a {kind} with its unit, such as {EXAMPLES[kind]}{or_else}{other}")
    value = number * size
    if not math.isfinite(value):
        raise ValueError(f"expected a {kind} that is smaller")
    return value


def has_digits(text: str) -> bool:
    """Return whether a text contains an ASCII digit."""
    return any(sign in "0123456789" for sign in text)


def usual(read: str, kind: Quantity | None) -> str:
    """Return a hint with the usual spelling of a unit, or an empty text.

    >>> usual("Hz", "speed"), usual(",5", None)
    ('; did you mean `rev/s` or `rad/s`?', ' (with a decimal point)')
    >>> usual("kg", "torque"), usual("N", "torque")
    ('; `kg` is a unit of mass', '; `N` is a unit of force')
    """
    hint = slip(read) or further(read)
    if hint or kind is None:
        return hint or mixed_letters(read)
    letters = _letters(read)
    alike = (usual for usual in _USUAL[kind] if _letters(usual) == letters)
    meant = next(alike, _MEANT.get(letters))
    if meant:
        return f"; did you mean `{meant}`?"
    if measure := _measure(read.strip()):
        return f"; `{read.strip()}` is a unit of {measure}"
    return nearest(read[:LONGEST_UNIT], _USUAL[kind]) or mixed_letters(read)


def _measure(text: str) -> str:
    """Return the measure of a unit that is not a speed, torque or power; empty if unknown."""
    if text in _MASSES:
        return "mass"
    parts = factors(text) if text else []
    return parts[0][0] if len(parts) == 1 and parts[0][0] in _MEASURES else ""


def _letters(text: str) -> str:
    return re.sub(r"[\W_]", "", text).casefold()


def with_article(kind: str) -> str:
    """Return the noun of a measure with an article: `an inertia`."""
    noun = kind.removeprefix("si_").replace("_", " ")
    return f"an {noun}" if noun[0] in "aei" else f"a {noun}"


class WithUnit(float):
    """Speed in rpm or torque in N*m, in contrast to a number relative to the input."""

    quantity: Quantity

    def __new__(cls, value: float, quantity: Quantity) -> Self:
        """Store the value and the quantity."""
        value_with_unit = super().__new__(cls, value)
        value_with_unit.quantity = quantity
        return value_with_unit

    def __format__(self, spec: str) -> str:
        return f"{super().__format__(spec)} {UNITS[self.quantity]}"


def relative(text: str, kind: Quantity) -> float:
    """Return a number relative to the input, or a speed or torque with a unit.

    Raises
    ------
    ValueError
        The message states the expectation.

    Examples
    --------
    >>> relative("1/500", "torque"), relative("3 N*m", "torque")
    (0.002, 3.0)
    """
    if has_digits(text):
        _, behind = calculated(text)
        if not behind or behind[0] in "%:":
            return dimensionless(text)
    if not any(sign.isalpha() for sign in text):
        raise ValueError(expected(text))
    return WithUnit(quantity(text, kind, f", or a number relative to the input {kind}"), kind)


def common_unit(text: str) -> tuple[str, str]:
    """Return the values of `--vary` with units replaced by blanks, and the common unit.

    Raises
    ------
    ValueError
        If the values have different units.

    Examples
    --------
    >>> common_unit("1000 rpm:2000 rpm:11"), common_unit("0.1,0.2")
    (('1000    :2000    :11', 'rpm'), ('0.1,0.2', ''))
    """
    units: dict[str, None] = {}
    bare = list(text)
    at = 0
    for cell in re.split(r"[:,]", text):
        number = cell.rpartition("=")[2]
        try:
            unit = calculated(number.strip()).behind
        except ValueError:
            unit = ""
        if unit:
            units[unit] = None
            begin = at + cell.rindex(unit)
            bare[begin : begin + len(unit)] = " " * len(unit)
        at += len(cell) + 1
    if len(units) > 1:
        raise ValueError(f"read values in {' and '.join(units)}, expected one unit for all")
    return "".join(bare), next(iter(units), "")
