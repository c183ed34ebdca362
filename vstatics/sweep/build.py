"""Construction of the plan of a sweep from the options of a command, sweep file or call."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import zip_longest
from typing import TYPE_CHECKING, TypeVar, cast

import numpy as np

from vstatics.core.errors import CaseError, Place, Problem, ReadError
from vstatics.core.extras import require
from vstatics.core.model.laws import with_varied_load
from vstatics.core.model.transmission import IdleConvention, Transmission
from vstatics.core.numerics.arrays import Floats, as_list
from vstatics.core.readers.named.nodes import MOST_PROBLEMS
from vstatics.core.statics.solve import solve
from vstatics.core.tables.written_results import GEAR
from vstatics.sweep.blocks import possible_numbers
from vstatics.sweep.formats import Format
from vstatics.sweep.options import SweepOptions, Text, located
from vstatics.sweep.plan import SweepPlan
from vstatics.sweep.results.columns import read_columns
from vstatics.sweep.results.documents import Subject
from vstatics.sweep.results.expressions import Terms
from vstatics.sweep.results.linked import linked_variants, table_of
from vstatics.sweep.results.meanings import OMEGA
from vstatics.sweep.results.selection import read_objective, read_where
from vstatics.sweep.runs import piece_of_runs
from vstatics.sweep.variants.numbered import VariantGrid, Variants, VariantTable, Zip
from vstatics.sweep.variants.path_numbers import CasePath
from vstatics.sweep.variants.samples import Method, Sample
from vstatics.sweep.variants.subject import target_of, varied_beside_teeth
from vstatics.sweep.variants.table_file import load_table
from vstatics.sweep.variants.targets import Target, Varied
from vstatics.sweep.variants.variation import Variation, read_variation

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

Read = TypeVar("Read")

OUT = "ratio,efficiency"
_ONE_TEXT = "; with a unit they are one text, such as '100 N*m,200 N*m'"


def check_packages(options: SweepOptions, form: Format, scheduler: str | None) -> None:
    """Check that the packages of a sweep are installed, before anything is calculated.

    Raises
    ------
    CaseError
    """
    if form == "parquet":
        require("parquet", "Parquet")
    if form == "xlsx":
        require("xlsx", "XLSX")
    if scheduler is not None:
        require("dask", "--scheduler")
    if options.sample is not None and options.method != "random":
        require("sample", f"--method {options.method or 'sobol'}")


def plan(
    subject: Subject,
    options: SweepOptions,
    *,
    arrays: Mapping[str, ArrayLike | str] | None = None,
    table: Mapping[str, ArrayLike] | None = None,
) -> SweepPlan:
    """Build the plan of a sweep from options.

    Parameters
    ----------
    subject : Transmission or VariedScenario
    options : SweepOptions
    arrays : mapping of str to array_like or str, optional
        Further numbers to vary: arrays of values [-], or values as text, by the name of the number.
    table : mapping of str to array_like, optional
        Table of variants instead of varied numbers: the values in all variants, by the name. [-]

    Raises
    ------
    ReadError
        With all errors in the texts of the options.
    CaseError
        If the sweep is impossible.
    """
    if isinstance(subject, Transmission):
        idle = cast("IdleConvention", options.idle or subject.idle)
        subject = replace(subject.with_coast(options.coast), idle=idle)
    places: Sequence[Place | None] = ()
    if table is not None:
        variants: Variants = _table(subject, table)
    else:
        variants, places = _variants(subject, options, arrays or {})
    try:
        variants, places = linked_variants(subject, variants, places, options.linked)
        _check_ratios(subject, variants.targets, places)
        if isinstance(subject, Transmission) and subject.depends:
            subject = with_varied_load(subject, (target.name for target in variants.targets))
        if isinstance(subject, Transmission) and variants.count:
            _check_paths(subject, variants, places)
        sweep_plan = with_expressions(subject, options, variants)
        if isinstance(subject, Transmission):
            _check_slopes(sweep_plan)
    except BaseException:
        if source := table_of(variants):
            source.close()
        raise
    return sweep_plan


def _variants(
    subject: Subject, options: SweepOptions, arrays: Mapping[str, ArrayLike | str]
) -> tuple[Variants, Sequence[Place | None]]:
    """Return the variants, and for messages the places where varied numbers are written.

    The place is None for a number that varies by an array.
    """
    if options.variants is not None:
        listed = load_table(options.variants, subject)
        return listed, [Place(options.variants, 1, 1)] * len(listed.targets)
    problems: list[Problem] = []
    given: list[Text | tuple[str, ArrayLike]] = [
        *options.vary,
        *(
            Text(f"{name}={values}") if isinstance(values, str) else (name, values)
            for name, values in arrays.items()
        ),
    ]
    texts = [item for item in given if isinstance(item, Text)]
    read = iter(_all(texts, lambda text: read_variation(text, subject), problems))
    if problems:
        raise ReadError(problems)
    variations = [
        (variation := next(read))._replace(place=item.place(1) or variation.place)
        if isinstance(item, Text)
        else Variation(target_of(item[0], subject), as_list(*item, _ONE_TEXT))
        for item in given
    ]
    if options.sample is not None:
        method = cast("Method", options.method or "sobol")
        variants: Variants = Sample(variations, options.sample, method, options.seed or 0)
    else:
        variants = Zip(variations) if options.zip else VariantGrid(variations)
    return variants, [variation.place for variation in variations]


def _check_paths(case: Transmission, variants: Variants, places: Sequence[Place | None]) -> None:
    """Check that the first variant can be solved with the numbers that vary by path.

    Raises
    ------
    ReadError
        If a varied path prevents the solution, with the place of the first such path.
    CaseError
        If this path was not read from a text, so that it has no place.
    """
    numbers, _ = possible_numbers(case, variants.targets, variants.block(0, 1))
    paths = [(n, path) for n, path in enumerate(variants.targets) if isinstance(path, CasePath)]
    given: dict[str, Floats] = {}
    for n, path in sorted(paths, key=lambda item: "load." not in item[1].quantity):
        if path.of:
            given[path.solved] = path.in_si(numbers[:, n])
            try:
                solve(case, vary=given)
            except CaseError as error:
                if not places or places[n] is None:
                    raise
                placed = dict.fromkeys(
                    problem._replace(place=places[n], path=()) for problem in error.problems
                )
                raise ReadError([*placed]) from None


def _check_ratios(
    subject: Subject, targets: Sequence[Varied], places: Sequence[Place | None]
) -> None:
    """Check that no ratio varies together with teeth that determine the ratio.

    Raises
    ------
    ReadError
    """
    if not isinstance(subject, Transmission):
        subject.check_targets(targets, places)
        return
    parts = [varied.part for varied in targets if isinstance(varied, CasePath) and varied.part]
    keys = [part.keys for part in parts]
    names = {name for key, name, *below in keys if key == "elements" and "teeth" in below}
    sets = [device for device in subject.own_devices if device.name in names]
    follow = {n for device in sets for n in device.mechanisms}
    for target, place in zip_longest(targets, places):
        if isinstance(target, Target) and target.quantity == "ratio" and target.owner in follow:
            raise varied_beside_teeth(target.name, place)


def _check_slopes(sweep_plan: SweepPlan) -> None:
    """Refuse natural frequencies if a load varies and a spring has a nonlinear characteristic."""
    if not sweep_plan.modes:
        return
    bent = [spring.name for spring in sweep_plan.case.springs if spring.points]
    varied = [path.path for path in sweep_plan.paths if path.of]
    if bent and varied:
        message = (
            f"the stiffness of {bent[0]}, which has `points`, depends on its torque, so `{OMEGA}` "
            f"cannot be calculated while {varied[0]} varies: vary other numbers"
        )
        raise CaseError("E720", message)


def _table(subject: Subject, columns: Mapping[str, ArrayLike]) -> VariantTable:
    targets = [target_of(name, subject) for name in columns]
    arrays = [as_list(name, values, _ONE_TEXT) for name, values in columns.items()]
    if len({len(array) for array in arrays}) != 1:
        lengths = ", ".join(f"{name} {len(a)}" for name, a in zip(columns, arrays, strict=True))
        message = f"variants: expected the same number of values for each ({lengths or 'none'})"
        raise CaseError("E702", message)
    return VariantTable(targets, np.column_stack(arrays))


def with_expressions(subject: Subject, options: SweepOptions, variants: Variants) -> SweepPlan:
    """Build a plan from variants and the expressions of options.

    Raises
    ------
    ReadError
        With all errors in the texts of the options.
    CaseError
        If the sweep is impossible.
    """
    targets = variants.targets
    problems: list[Problem] = []

    def read(texts: Iterable[Text], reader: Callable[..., Read], *more: str) -> list[Read]:
        return _all(texts, lambda text: reader(text, subject, terms, *more), problems)

    by_gear = options.by == GEAR
    if by_gear and not isinstance(subject, Transmission):
        raise CaseError(
            "E719",
            "a row for each gear needs a case: a run of a scenario passes through several gears",
        )
    terms = Terms(targets, by_gear=by_gear)
    out = OUT if isinstance(subject, Transmission) else subject.default_columns
    columns = read([options.out or Text(out)], read_columns)
    terms = terms._replace(named=columns[0].named if columns else {})
    where = read(filter(None, [options.where]), read_where)
    least = read(options.min, read_objective, "--min")
    most = read(options.max, read_objective, "--max")
    if problems:
        raise ReadError(problems)
    condition = where[0] if where else None
    objectives = (*least, *most)
    sweep_plan = SweepPlan(
        subject, variants, columns[0], condition, objectives, options.best, by_gear=by_gear
    )
    if isinstance(subject, Transmission):
        return sweep_plan
    subject.check_runs(variants.targets, variants.block(0, 1)[0].tolist())
    return replace(
        sweep_plan, piece=piece_of_runs(variants.count)
    )  # simulated runs are slow, so pieces are small


def _all(
    texts: Iterable[Text], reader: Callable[[str], Read], problems: list[Problem]
) -> list[Read]:
    read = []
    for text in texts:
        try:
            with located(text):
                read.append(reader(text.text))
        except ReadError as error:
            problems += error.problems
            if len(problems) >= MOST_PROBLEMS:
                break
    return read
