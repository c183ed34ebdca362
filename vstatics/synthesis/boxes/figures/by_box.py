"""Figures (characteristic numbers) by which found gearboxes are compared."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from vstatics.core.errors import CaseError, Problem, quoted, spoken
from vstatics.core.suggestions import nearest


class BoxFigures(NamedTuple):
    """Figures of a found gearbox, of which smaller values are better, and two yes-no properties."""

    error: float
    """Largest deviation ``|ln(i/target)|`` of the gears. [-]"""
    loss: float
    """Mean of 1 - efficiency over the forward gears, or over all gears without a forward gear. [-]
    """
    planet_speed: float
    """Largest planet speed relative to the carrier, divided by the input speed. [-]"""
    slip: float
    """Largest slip speed of a disengaged shift element, divided by the input speed. [-]"""
    torque: float
    """Largest torque of an engaged shift element without losses, divided by the input torque. [-]
    """
    brakes: int
    clutches: int
    drag: float
    """Weighted mean drag of the forward gears, or of all gears without a forward gear. [-]"""
    skip_shifts: int
    """Number of pairs of non-adjacent forward gears that differ by exchange of a single element.
    """
    reversing: tuple[str, ...]
    """Names of shift elements with positive torque in some gears and negative in other gears."""
    one_way: tuple[str, ...]
    """Names of brakes that a one-way clutch could replace."""
    beyond: tuple[float, ...]
    """Further ratios that other combinations of the shift elements give, forward first. [-]"""
    single: bool
    """True if neighbouring gears differ by exchange of a single shift element."""
    planar: bool
    """True if the gearbox can be drawn without crossing shafts."""

    def number(self, name: str) -> float:
        """Return a figure as a number, best if small: length of a list, 0 for True, 1 for False.

        Examples
        --------
        >>> box = BoxFigures(0, 0, 0, 0, 0, 2, 2, 0, 1, ("A", "B"), (), (0.5,), True, False)
        >>> [box.number(name) for name in ("brakes", "reversing", "single", "planar")]
        [2.0, 2.0, 0.0, 1.0]
        """
        value = getattr(self, name)
        if isinstance(value, bool):
            return float(not value)
        return float(len(value) if isinstance(value, tuple) else value)


FIGURES = BoxFigures._fields
LIMITED = tuple(name for name in FIGURES if name not in ("single", "planar"))
"""Names of figures that can have an upper limit."""


PARETO = ("loss", "planet_speed", "torque", "clutches")
"""Names of the figures that the Pareto list compares by default."""


class BoxOrder(NamedTuple):
    """Figures that determine the order of gearboxes and the Pareto list.

    Examples
    --------
    >>> BoxOrder(sort=("drag",)).pareto
    ('loss', 'planet_speed', 'torque', 'clutches')
    """

    sort: tuple[str, ...] = ()
    """Names of figures to order by, before the usual order."""
    pareto: tuple[str, ...] = PARETO

    def check(self) -> None:
        """Check that the names of figures exist.

        Raises
        ------
        CaseError
            If a name is unknown, with the name of the option as its path.
        """
        check_figures("sort", self.sort)
        check_figures("pareto", self.pareto)


USUAL = BoxOrder()


def check_figures(option: str, names: Iterable[str]) -> None:
    """Check that names are names of figures.

    Raises
    ------
    CaseError
        If a name is unknown, with the name of the option as its path.

    Examples
    --------
    >>> check_figures("sort", ["loss", "drag"])
    >>> check_figures("sort", ["los"])
    Traceback (most recent call last):
    vstatics.core.errors.CaseError: sort: read `los`, but there is no such figure; did you mean \
`loss`? [E795]
    """
    problems = [
        Problem("E795", no_figure(name, FIGURES), (option,))
        for name in names
        if name not in FIGURES
    ]
    if problems:
        raise CaseError(problems)


def no_figure(name: str, known: Sequence[str]) -> str:
    """Return the message about an unknown figure.

    >>> no_figure("x", ["loss", "slip"])
    'read `x`, but there is no such figure; expected loss or slip'
    """
    hint = nearest(name, known) or f"; expected {spoken(known, 'or')}"
    return f"read {quoted(name)}, but there is no such figure{hint}"
