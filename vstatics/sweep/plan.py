"""Everything that a sweep is: what is varied, what is kept of each variant."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, is_dataclass
from typing import Any

import numpy as np

from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.sweep.results.columns import OutputColumns, output_headings
from vstatics.sweep.results.documents import Subject
from vstatics.sweep.results.expressions import Expression
from vstatics.sweep.results.meanings import OF_RATIOS, OK, OMEGA, PART_NUMBERS, Tables
from vstatics.sweep.results.selection import Objective, WhereCondition
from vstatics.sweep.variants.numbered import Variants
from vstatics.sweep.variants.path_numbers import CasePath
from vstatics.sweep.variants.targets import Target

PIECE = 65536
"""Variants of a piece: what is calculated, kept and taken up again as a whole. Constant,
so that the result does not depend on the number of jobs."""


@dataclass(frozen=True)
class SweepPlan:
    """A sweep, checked when its parts were made; the same plan gives the same result.

    Parameters
    ----------
    subject : Transmission or VariedScenario
        A case with the conventions to use (`coast`, `idle`).
    variants : Variants
        The numbered variants.
    columns : OutputColumns
        What is written of each.
    where : WhereCondition, optional
        Which variants are written; all when not given.
    objectives : sequence of Objective
        If there are any only the best variants are written.
    best : int, optional
        So many at most. When not given 20 by one objective, all by several.
    piece : int
        Variants of a piece.
    by_gear : bool
        Whether each gear of a variant has a row.
    """

    subject: Subject
    variants: Variants
    columns: OutputColumns
    where: WhereCondition | None = None
    objectives: tuple[Objective, ...] = ()
    best: int | None = None
    piece: int = PIECE
    by_gear: bool = False

    @property
    def gears(self) -> tuple[str, ...]:
        """The gears of each variant that have a row; none where a row is of all of them."""
        return tuple(gear.name for gear in self.case.gears) if self.by_gear else ()

    @property
    def count(self) -> int:
        """Of what may have a row: variants, or their gears."""
        return self.variants.count * (len(self.gears) or 1)

    @property
    def case(self) -> Transmission:
        """What is swept, where that is a case."""
        assert isinstance(self.subject, Transmission)  # noqa: S101 - who asks knows it
        return self.subject

    @property
    def targets(self) -> tuple[Target, ...]:
        """What is varied of a case."""
        return tuple(one for one in self.variants.targets if isinstance(one, Target))

    @property
    def places(self) -> list[int]:
        """Where the columns of `targets` stand among all varied numbers."""
        return [n for n, one in enumerate(self.variants.targets) if isinstance(one, Target)]

    @property
    def paths(self) -> list[CasePath]:
        """What is varied of a case by its path."""
        return [one for one in self.variants.targets if isinstance(one, CasePath)]

    @property
    def parts(self) -> dict[int, CasePath]:
        """What is varied of the parts of a case, by its column: each set of numbers makes one."""
        paths = enumerate(self.variants.targets)
        return {n: one for n, one in paths if isinstance(one, CasePath) and one.part}

    @property
    def names(self) -> tuple[str, ...]:
        """Of the varied numbers."""
        return tuple(target.name for target in self.variants.targets)

    @property
    def headings(self) -> tuple[str, ...]:
        """Of the columns."""
        return self.columns.headings

    @property
    def output_headings(self) -> list[str]:
        """Of all that is written of a variant."""
        return output_headings(self.names, self.headings, by_gear=self.by_gear)

    @property
    def pieces(self) -> int:
        """How many pieces there are."""
        return -(-self.variants.count // self.piece)

    def span(self, piece: int) -> tuple[int, int]:
        """The first variant of a piece, and the one behind its last."""
        return piece * self.piece, min((piece + 1) * self.piece, self.variants.count)

    @property
    def expressions(self) -> Iterator[Expression]:
        """All that is asked of a variant."""
        yield from (part.expression for part in self.columns.parts)
        yield from (objective.expression for objective in self.objectives)
        if self.where is not None:
            yield from self.where.parts

    @property
    def tables(self) -> set[str]:
        """All tables that are asked for."""
        return {part.table for one in self.expressions for part in one.selections}

    @property
    def asks_for_results(self) -> bool:
        """Whether the results of statics are asked for: unless all that is asked is of modes."""
        return self.tables - {OK} != {OMEGA}

    @property
    def takes_all(self) -> bool:
        """Whether what can't be assembled may be among the best: the condition speaks of it."""
        parts = () if self.where is None else self.where.parts
        return any(one.table == OK for part in parts for one in part.selections)

    @property
    def asked_gears(self) -> list[int]:
        """Indices of the gears that are asked for: all where a number is of all, or of none."""
        every = [part for one in self.expressions for part in one.selections]
        parts = [part for part in every if part.table not in (OK, *PART_NUMBERS.values())]
        if not parts or any(part.gear is None or part.table in OF_RATIOS for part in parts):
            return [*range(len(self.case.gears))]
        return sorted({part.gear for part in parts if part.gear is not None})

    @property
    def modes(self) -> dict[int, list[int]]:
        """The natural frequencies that are asked for: index of a gear -> indices of modes."""
        asked: dict[int, set[int]] = {}
        for expression in self.expressions:
            for part in expression.selections:
                if part.table == OMEGA:
                    of_all = part.gear is None or self.by_gear
                    gears = range(len(self.case.gears)) if of_all else [part.gear or 0]
                    every = range(part.rows) if part.row is None else [part.row]
                    for gear in gears:
                        asked.setdefault(gear, set()).update(every)
        return {gear: sorted(modes) for gear, modes in sorted(asked.items())}

    def objective_values(self, tables: Tables, values: Floats) -> Floats:
        """(variants, objectives): each is better the smaller it is.

        To as many digits as are written, so that rounding prefers nobody.
        """
        objectives = np.empty((len(values), len(self.objectives)))
        for column, objective in enumerate(self.objectives):
            objectives[:, column] = objective.sign * rounded(objective.expression(tables, values))
        return objectives

    def fingerprint(self, *more: str) -> str:
        """A number for everything that decides the result, and for more texts.

        Two plans with the same fingerprint give the same file, with the same build of
        this package.
        """
        digest = hashlib.sha256()
        one = self.subject
        case = one if isinstance(one, Transmission) else one.base_case
        for part in _canonical((self, more, case.laws)):
            digest.update(part)
        return digest.hexdigest()


def rounded(numbers: Floats) -> Floats:
    """Numbers to 12 significant digits.

    >>> rounded(np.array([1 + 2**-52, -123456.7890123456, 0.0])).tolist()
    [1.0, -123456.789012, 0.0]
    """
    with np.errstate(all="ignore"):
        places = 11 - np.floor(np.log10(np.abs(numbers)))
        factors = 10.0 ** np.clip(places, -300, 300)
        short: Floats = np.where(np.isfinite(places), np.rint(numbers * factors) / factors, numbers)
    return np.where(np.isfinite(short), short, numbers)


def _canonical(part: Any) -> Iterator[bytes]:
    """A part of a plan as bytes that tell it from any other, the same in every process.

    What a class keeps in attributes that begin with an underscore follows from the others.
    """
    yield f"{type(part).__name__}(".encode()
    if isinstance(part, np.ndarray):
        yield f"{part.dtype.str} {part.shape} ".encode()
        yield np.ascontiguousarray(part).tobytes()
    elif isinstance(part, str | bytes | int | float | type(None)):
        yield repr(part).encode()
    else:
        for name, value in _parts(part):
            yield f"{name}=".encode()
            yield from _canonical(value)
    yield b")"


def _parts(part: Any) -> Iterator[tuple[object, Any]]:
    """What a part of a plan consists of, each with a name."""
    if isinstance(part, Mapping):
        yield from sorted(part.items(), key=lambda item: str(item[0]))
    elif is_dataclass(part):
        names = (field.name for field in fields(part))
        yield from ((name, getattr(part, name)) for name in names if not name.startswith("_"))
    elif isinstance(part, Sequence):
        yield from enumerate(part)
    else:
        yield from sorted(item for item in vars(part).items() if not item[0].startswith("_"))
