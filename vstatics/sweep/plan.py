"""Plan of a sweep: variants, columns, condition and objectives."""

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
from vstatics.sweep.results.meanings import (
    OF_RATIOS,
    OK,
    OMEGA,
    PART_NUMBERS,
    Selection,
    Tables,
)
from vstatics.sweep.results.selection import Objective, WhereCondition
from vstatics.sweep.variants.numbered import Variants
from vstatics.sweep.variants.path_numbers import CasePath
from vstatics.sweep.variants.targets import Target

PIECE = 65536
"""Number of variants in a piece, the part of a sweep that a worker calculates and stores.

The number is fixed, so that results do not depend on the number of processes.
"""


@dataclass(frozen=True)
class SweepPlan:
    """Plan of a sweep without errors. Equal plans give equal results.

    Parameters
    ----------
    subject : Transmission or VariedScenario
        A case with the conventions to use (`coast`, `idle`), or a scenario.
    variants : Variants
        The numbered variants.
    columns : OutputColumns
        Columns written for each variant.
    where : WhereCondition, optional
        Condition on the variants that are written; by default all are written.
    objectives : sequence of Objective
        Objectives; if there are any, only the best variants are written.
    best : int, optional
        Number of best variants; by default 20 for one objective, all for several.
    piece : int
        Number of variants in a piece.
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
        """Names of the gears if each gear of a variant has a row; otherwise empty."""
        return tuple(gear.name for gear in self.case.gears) if self.by_gear else ()

    @property
    def count(self) -> int:
        """Largest possible number of rows: variants, or gears of variants."""
        return self.variants.count * (len(self.gears) or 1)

    @property
    def case(self) -> Transmission:
        """Case that is varied; only for a sweep of a case."""
        assert isinstance(self.subject, Transmission)  # noqa: S101 - only called for cases
        return self.subject

    @property
    def targets(self) -> tuple[Target, ...]:
        """Varied numbers of the case that are given by owner and quantity, as in `D1.ratio`."""
        return tuple(varied for varied in self.variants.targets if isinstance(varied, Target))

    @property
    def places(self) -> list[int]:
        """Index of each of the `targets` among all varied numbers."""
        return [n for n, varied in enumerate(self.variants.targets) if isinstance(varied, Target)]

    @property
    def paths(self) -> list[CasePath]:
        """Varied numbers of the case that are given by a path, such as `load.torque`."""
        return [varied for varied in self.variants.targets if isinstance(varied, CasePath)]

    @property
    def parts(self) -> dict[int, CasePath]:
        """Varied numbers whose every value needs a new case, such as tooth numbers, by index."""
        paths = enumerate(self.variants.targets)
        return {n: varied for n, varied in paths if isinstance(varied, CasePath) and varied.part}

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the varied numbers."""
        return tuple(target.name for target in self.variants.targets)

    @property
    def headings(self) -> tuple[str, ...]:
        """Headings of the columns."""
        return self.columns.headings

    @property
    def output_headings(self) -> list[str]:
        """Headings of the output: variant, varied numbers, status, gear, columns."""
        return output_headings(self.names, self.headings, by_gear=self.by_gear)

    @property
    def pieces(self) -> int:
        """Number of pieces in the sweep."""
        return -(-self.variants.count // self.piece)

    def span(self, piece: int) -> tuple[int, int]:
        """Return the first variant of a piece, and the number after the last variant."""
        return piece * self.piece, min((piece + 1) * self.piece, self.variants.count)

    @property
    def selections(self) -> Iterator[Selection]:
        """Tables, or parts of tables, used by the expressions of the plan."""
        for part in self.columns.parts:
            yield from part.expression.selections
        for objective in self.objectives:
            yield from objective.expression.selections
        yield from self._selections_of_condition

    @property
    def _selections_of_condition(self) -> Iterator[Selection]:
        for part in () if self.where is None else self.where.parts:
            yield from part.selections

    @property
    def tables(self) -> set[str]:
        """Names of all tables that the expressions of the plan use."""
        return {part.table for part in self.selections}

    @property
    def asks_for_results(self) -> bool:
        """True if expressions need results of statics, not only natural frequencies."""
        return self.tables - {OK} != {OMEGA}

    @property
    def takes_all(self) -> bool:
        """True if the condition uses the status; then variants not assembled are ranked, too."""
        return any(part.table == OK for part in self._selections_of_condition)

    @property
    def asked_gears(self) -> list[int]:
        """Indices of the gears that expressions use; all gears if an expression uses all."""
        of_parts = PART_NUMBERS.values()
        parts = [part for part in self.selections if part.table not in (OK, *of_parts)]
        if not parts or any(part.gear is None or part.table in OF_RATIOS for part in parts):
            return [*range(len(self.case.gears))]
        return sorted({part.gear for part in parts if part.gear is not None})

    @property
    def modes(self) -> dict[int, list[int]]:
        """Indices of the natural frequencies that expressions use, by the index of the gear."""
        asked: dict[int, set[int]] = {}
        for part in self.selections:
            if part.table == OMEGA:
                of_all = part.gear is None or self.by_gear
                gears = range(len(self.case.gears)) if of_all else [part.gear or 0]
                every = range(part.rows) if part.row is None else [part.row]
                for gear in gears:
                    asked.setdefault(gear, set()).update(every)
        return {gear: sorted(modes) for gear, modes in sorted(asked.items())}

    def objective_values(self, tables: Tables, values: Floats) -> Floats:
        """Return the values of the objectives, shape (variants, objectives); smaller is better.

        Values are rounded as in the output, so that rounding noise does not decide between
        variants.
        """
        objectives = np.empty((len(values), len(self.objectives)))
        for column, objective in enumerate(self.objectives):
            objectives[:, column] = objective.sign * rounded(objective.expression(tables, values))
        return objectives

    def fingerprint(self, *more: str) -> str:
        """Return a hash of everything that determines the result, and of further texts.

        For the same version of this package, equal hashes give equal files.
        """
        digest = hashlib.sha256()
        subject = self.subject
        case = subject if isinstance(subject, Transmission) else subject.base_case
        for part in _canonical((self, more, case.laws)):
            digest.update(part)
        return digest.hexdigest()


def rounded(numbers: Floats) -> Floats:
    """Round numbers to 12 significant digits.

    >>> rounded(np.array([1 + 2**-52, -123456.7890123456, 0.0])).tolist()
    [1.0, -123456.789012, 0.0]
    """
    with np.errstate(all="ignore"):
        places = 11 - np.floor(np.log10(np.abs(numbers)))
        factors = 10.0 ** np.clip(places, -300, 300)
        short: Floats = np.where(np.isfinite(places), np.rint(numbers * factors) / factors, numbers)
    return np.where(np.isfinite(short), short, numbers)


def _canonical(part: Any) -> Iterator[bytes]:
    """Yield bytes that identify an object in a plan, equal in every process.

    Attributes that begin with an underscore follow from other attributes, and are left out.
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
    """Yield the items or attributes of an object in a plan, each with a key or name."""
    if isinstance(part, Mapping):
        yield from sorted(part.items(), key=lambda item: str(item[0]))
    elif is_dataclass(part):
        names = (field.name for field in fields(part))
        yield from ((name, getattr(part, name)) for name in names if not name.startswith("_"))
    elif isinstance(part, Sequence):
        yield from enumerate(part)
    else:
        yield from sorted(item for item in vars(part).items() if not item[0].startswith("_"))
