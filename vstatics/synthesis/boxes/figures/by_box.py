"""By what found boxes are judged and compared: one figure of a box each."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from vstatics.core.errors import CaseError, Problem, quoted, spoken
from vstatics.core.suggestions import nearest


class BoxFigures(NamedTuple):
    """By what boxes are compared: the less the better, and two that are so or not."""

    error: float
    """The largest ``|ln(i/target)|``. [-]"""
    loss: float
    """The mean of 1 - efficiency of the forward gears; of all if there are none. [-]"""
    planet_speed: float
    """The largest speed of a planet against its carrier/input speed of all gears. [-]"""
    slip: float
    """The largest ``|slip|`` of an open element/input speed. [-]"""
    torque: float
    """The largest ``|torque|`` of an engaged element/input torque, without losses. [-]"""
    brakes: int
    clutches: int
    drag: float
    """The weighted mean of the drag of the forward gears; of all if there are none. [-]"""
    skip_shifts: int
    """So many pairs of forward gears, not neighbours, differ by one element that goes and one that
    comes."""
    reversing: tuple[str, ...]
    """Elements whose torque has both signs."""
    one_way: tuple[str, ...]
    """Brakes that a one-way clutch may replace."""
    beyond: tuple[float, ...]
    """Ratios of one motion that are not told: forward and falling, then backward. [-]"""
    single: bool
    """Whether one element changes between neighbours."""
    planar: bool
    """Whether it can be drawn without shafts that cross."""

    def number(self, name: str) -> float:
        """A figure as a number: of a list its length, of what is so 0, else 1.

        Examples
        --------
        >>> own = BoxFigures(0, 0, 0, 0, 0, 2, 2, 0, 1, ("A", "B"), (), (0.5,), True, False)
        >>> [own.number(name) for name in ("brakes", "reversing", "single", "planar")]
        [2.0, 2.0, 0.0, 1.0]
        """
        value = getattr(self, name)
        if isinstance(value, bool):
            return float(not value)
        return float(len(value) if isinstance(value, tuple) else value)


FIGURES = BoxFigures._fields
LIMITED = tuple(name for name in FIGURES if name not in ("single", "planar"))
"""The figures that can have a limit."""


PARETO = ("loss", "planet_speed", "torque", "clutches")
"""The figures of the Pareto list."""


class BoxOrder(NamedTuple):
    """By which figures boxes stand in order, and have to be best.

    Examples
    --------
    >>> BoxOrder(sort=("drag",)).pareto
    ('loss', 'planet_speed', 'torque', 'clutches')
    """

    sort: tuple[str, ...] = ()
    """Before all others."""
    pareto: tuple[str, ...] = PARETO

    def check(self) -> None:
        """Refuse names of no figures.

        Raises
        ------
        CaseError
            With the name of the option as its path.
        """
        check_figures("sort", self.sort)
        check_figures("pareto", self.pareto)


USUAL = BoxOrder()


def check_figures(option: str, names: Iterable[str]) -> None:
    """Refuse names that are no figures.

    Raises
    ------
    CaseError
        With the name of the option as its path.

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
    """What is told of a name that is none of some figures.

    >>> no_figure("x", ["loss", "slip"])
    'read `x`, but there is no such figure; expected loss or slip'
    """
    hint = nearest(name, known) or f"; expected {spoken(known, 'or')}"
    return f"read {quoted(name)}, but there is no such figure{hint}"
