"""Equations as data and as text, broken into lines."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import partial
from typing import NamedTuple

from vstatics.core.statics.matrix import GIVEN_SPEED, INPUT_SPEED
from vstatics.core.tables.answer import defined, json_keys
from vstatics.core.tables.numbers import short
from vstatics.core.texts import tr

EQUATION_WIDTH = 80
"""Width of a line, in characters."""
INDENT = "  "
"""Indentation of a line."""


class Term(NamedTuple):
    """Term of an equation: coefficient times unknown."""

    unknown: str
    symbol: str
    """Coefficient in symbols, such as ``1``, ``-u_P1`` or ``u_P1 eta_P1 - 1``."""
    coefficient: float
    """Value of the coefficient. [-]"""


@json_keys("of", "symbols", "numbers", "terms", "right")
class Equation(NamedTuple):
    """Linear equation ``sum(coefficient x unknown) = right``."""

    of: str
    """Name of the device, link or condition described by the equation."""
    terms: Sequence[Term]
    right: float
    """Right-hand side. [-]"""

    @property
    def label(self) -> str:
        """Name of the device, link or condition, in the current language."""
        name = self.of.removeprefix(GIVEN_SPEED)
        if name != self.of:
            return tr("the given speed of link {name}", name=name)
        return tr(INPUT_SPEED) if self.of == INPUT_SPEED else self.of

    @property
    def symbols(self) -> str:
        """Equation in symbols."""
        return " ".join(in_symbols(self))

    @property
    def numbers(self) -> str:
        """Equation in numbers."""
        return " ".join(in_numbers(self))


@defined("system")
class System(NamedTuple):
    """System of equations with the solution."""

    equations: Sequence[Equation]
    values: Mapping[str, float]
    """Value of each unknown; NaN if indeterminate. [-]"""


def in_symbols(equation: Equation) -> list[str]:
    """Return the terms and the right-hand side of an equation in symbols.

    Examples
    --------
    >>> from vstatics.core.explain.equations import Term
    >>> row = Equation("P", [Term("w_1", "1", 1.0), Term("w_2", "u_P - 1", -3.5)], 0.0)
    >>> in_symbols(row), in_numbers(row)
    (['w_1', '+ (u_P - 1) w_2', '= 0'], ['w_1', '- 3.5 w_2', '= 0'])
    """
    terms = (
        (f"({term.symbol})" if " - " in term.symbol else term.symbol, term.unknown)
        for term in equation.terms
    )
    return _sum(terms, equation.right)


def in_numbers(equation: Equation, digits: int | None = None) -> list[str]:
    """Return the terms and the right-hand side in numbers, with `digits` decimals."""
    shown = partial(short, digits=digits)
    terms = [(shown(term.coefficient), term.unknown) for term in equation.terms if term.coefficient]
    return _sum(terms, equation.right, digits)


def _sum(terms: Iterable[tuple[str, str]], right: float, digits: int | None = None) -> list[str]:
    parts: list[str] = []
    for factor, unknown in terms:
        size = factor.removeprefix("-")
        sign = "-" if factor.startswith("-") else "+"
        text = unknown if size == "1" else f"{size} {unknown}"
        front = f"{sign} " if parts else "-" * (sign == "-")
        parts.append(front + text)
    return [*(parts or ["0"]), f"= {short(right, digits)}"]


def filled(parts: Iterable[str], front: str) -> Iterator[str]:
    """Yield the lines of a sum, broken before a sign."""
    line, started = front, False
    for part in parts:
        if started and len(line) + 1 + len(part) > EQUATION_WIDTH:
            yield line
            line, started = " " * (len(front) + 2), False
        line += f" {part}" if started else part
        started = True
    yield line


def listed(texts: Iterable[str], front: str) -> Iterator[str]:
    """Yield lines of short texts, separated by two blanks."""
    line = front
    for text in texts:
        if line.strip() and len(line) + len(text) > EQUATION_WIDTH:
            yield line.rstrip()
            line = front
        line += f"{text}  "
    yield line.rstrip()
