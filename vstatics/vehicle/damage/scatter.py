"""Scatter of strength and stress, and the distribution of lives that results."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from typing import Any, Literal, NamedTuple, Self

import numpy as np

from vstatics.core.model.shape import Measure
from vstatics.core.numerics.arrays import Floats
from vstatics.core.readers.named.scalars import number
from vstatics.core.readers.named.si_units import in_any_unit
from vstatics.core.tables.answer import json_keys

SHARES = np.arange(1, 100) / 100
"""Shares of failed components for which a life is calculated. [-]"""
LARGEST_LOG_DEVIATION = 10.0
"""Largest standard deviation of the natural logarithm of a stress. [-]"""
_DISTRIBUTION = re.compile(r"\s*(normal|lognormal)\s*\((.*),(.*)\)\s*")
_CALL = re.compile(r"\s*[A-Za-z]+\s*\(")


class Scattered(float):
    """Random stress; the number is the median (lognormal) or the mean (normal) [Pa].

    Examples
    --------
    >>> Scattered(100e6, "lognormal", 0.08)
    100000000.0
    """

    kind: Literal["normal", "lognormal"]
    spread: float
    """Standard deviation of a normal stress [Pa], or of the logarithm of a lognormal stress [-]."""
    measure: Measure | None

    def __new__(
        cls,
        middle: float,
        kind: Literal["normal", "lognormal"],
        spread: float,
        measure: Measure | None = None,
    ) -> Self:
        """Create a distribution with a median or mean `middle`."""
        scattered = super().__new__(cls, middle)
        scattered.kind, scattered.spread, scattered.measure = kind, spread, measure
        return scattered

    def samples(self, count: int, random: np.random.Generator) -> Floats:
        """Return random stresses [Pa]; values of 0 or below are drawn again."""
        if self.kind == "lognormal":
            return float(self) * np.exp(self.spread * random.standard_normal(count))
        drawn: Floats = random.normal(float(self), self.spread, count)
        while (wrong := drawn <= 0).any():
            drawn[wrong] = random.normal(float(self), self.spread, int(wrong.sum()))
        return drawn


def read_scattered(text: str) -> Scattered | None:
    """Return the distribution of a stress in a text, None if the text is not a distribution.

    Raises
    ------
    ValueError
        If the distribution is invalid; the message states what was expected.

    Examples
    --------
    >>> stress = read_scattered("normal(100 MPa, 8 MPa)")
    >>> stress, stress.kind, stress.spread, read_scattered("100 MPa")
    (100000000.0, 'normal', 8000000.0, None)
    """
    match = _DISTRIBUTION.fullmatch(text)
    if match is None and _CALL.match(text):
        form = "lognormal(100 MPa, 0.08)"
        raise ValueError(f"expected a stress, or a distribution such as {form!r}")
    if match is None:
        return None
    kind: Any = match[1]
    middle = in_any_unit(match[2].strip(), ["stress"])
    spread: float = number(match[3].strip()) if kind == "lognormal" else 0.0
    if kind == "normal":
        deviation = in_any_unit(match[3].strip(), ["stress"])
        if deviation.measure != middle.measure:
            raise ValueError("expected a unit of both numbers, or of none")
        spread = float(deviation)
    if kind == "lognormal" and spread > LARGEST_LOG_DEVIATION:
        raise ValueError(f"expected a deviation of the logarithm up to {LARGEST_LOG_DEVIATION:g}")
    if not (0 < middle < math.inf and 0 < spread < math.inf):
        raise ValueError("expected a median or mean, and a deviation, above 0")
    return Scattered(float(middle), kind, spread, middle.measure)


def drawn(given: float, count: int, random: np.random.Generator) -> Floats:
    """Return random samples of a `Scattered` number, or copies of any other number."""
    if isinstance(given, Scattered):
        return given.samples(count, random)
    return np.full(count, float(given))


@json_keys("B10", "B50", "mean", "curve", count="number")
class LifeSamples(NamedTuple):
    """Distribution of the lives of random samples."""

    number: int
    B10: float
    """Life that 10 % of samples do not reach, infinite if unlimited."""
    B50: float
    """Life that 50 % of samples do not reach."""
    mean: float
    curve: Sequence[tuple[float, float]]
    """Pairs of a finite life and the share of failed samples, one for each whole per cent."""

    @classmethod
    def of(cls, lives: Floats) -> LifeSamples:
        """Return the distribution of lives, some of which can be infinite.

        >>> LifeSamples.of(np.arange(1.0, 101.0))[1:4]
        (10.0, 50.0, 50.5)
        """
        ordered = np.sort(lives)
        places = np.ceil(SHARES * len(ordered) - 1e-9).astype(int) - 1
        quantiles = ordered[np.maximum(places, 0)].tolist()
        curve = [
            (life, share)
            for life, share in zip(quantiles, SHARES.tolist(), strict=True)
            if math.isfinite(life)
        ]
        return cls(len(ordered), quantiles[9], quantiles[49], float(ordered.mean()), curve)
