"""Units of speeds, torques and powers as the trade writes them: what they measure, their size."""

from __future__ import annotations

import math
import re
from typing import Literal

Quantity = Literal["speed", "torque", "power"]

_Factor = tuple[str, int, float]
"""What a unit is made of, and its size as a ratio: in N, m, turns, minutes, kW."""
_LB, _FT, _G = (45359237, 10**8), (3048, 10**4), (980665, 10**5)
"""The pound in kg and the foot in m (International Yard and Pound, 1959), standard gravity in
m/s^2 (3rd CGPM, 1901): exact."""
_LBF = (_LB[0] * _G[0], _LB[1] * _G[1])

_PREFIXED: dict[str, _Factor] = {
    **dict.fromkeys(("N", "Н", "newton", "newtons"), ("force", 1, 1)),
    **dict.fromkeys(("m", "м", "meter", "meters", "metre", "metres"), ("length", 1, 1)),
    **dict.fromkeys(("W", "Вт", "watt", "watts"), ("power", 1, 1000)),
}
"""By their exact letters, with a prefix or without."""
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
_WORDS: dict[str, _Factor] = {
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
        ("rev revs revolution revolutions turn turns cycle cycles r u umdr tr об", "angle", 1, 1),
        ("rad radian radians рад", "angle", 1, 2 * math.pi),
        ("deg degree degrees °", "angle", 1, 360),
        ("min minute minutes мин", "time", 1, 1),
        ("s sec second seconds с сек", "time", 1, 60),
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
"""In letters of any size."""

_KINDS: dict[str, tuple[Quantity, int]] = {
    "speed": ("speed", 1),
    "/time angle": ("speed", 1),
    "force length": ("torque", 1),
    "power": ("power", 1),
    "/time force length": ("power", 60_000),  # N*m/min
}
"""Kinds of factors -> what they are together, and by what they are divided."""

_SIGNS = str.maketrans("·⋅×⁻¹", "***-1")
_FACTOR = re.compile(r" *([*./-]?) *(1(?= */)|[^\W\d_]+|°)(?:(?:\^|\*\*)?(-?1)(?![0-9]))?")
LONGEST = 40
"""Characters of a unit."""


def unit(text: str) -> tuple[Quantity | None, float]:
    """What a unit measures, and its size in rpm, N*m or kW; none if it is not understood.

    Parameters
    ----------
    text : str
        Factors with `*`, `.`, `-`, a blank or nothing between them, or `/`; exponents 1 and -1.

    Examples
    --------
    >>> unit("kNm"), unit("min^-1"), unit("furlong/fortnight")
    (('torque', 1000.0), ('speed', 1.0), (None, 1.0))
    """
    text = text.translate(_SIGNS).replace("л.с.", "лс").replace(" per ", "/")
    kinds: list[str] = []
    above: float = 1
    below: float = 1
    at = 0
    while at < len(text) <= LONGEST:
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
    """What a word without signs is made of: N and m for `Nm`, nothing known for `Mm2`."""
    for end in range(len(word), 0, -1) if word != "1" else ():
        parts = [_factor(part) for part in (word[:end], word[end:]) if part]
        known = [part for part in parts if part]
        if len(known) == len(parts):
            return known
    return [] if word == "1" else [("?", 1, 1)]


def _factor(word: str) -> _Factor | None:
    for prefix, (up, down) in _PREFIXES.items():
        if word.startswith(prefix) and (known := _PREFIXED.get(word[len(prefix) :])):
            kind, above, below = known
            return kind, above * up, below * down
    return _WORDS.get(word.casefold())
