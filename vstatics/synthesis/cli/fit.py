"""`vstatics synth fit`: find ratios of mechanisms for wanted ratios of gears."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

import click

from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.files import file_name
from vstatics.core.cli.shared.one_case import CaseAnswer, OneCase, one_case, warnings_of
from vstatics.core.cli.shared.options import command, gathered
from vstatics.core.cli.shared.problems import Telling
from vstatics.core.cli.shared.progress import progress
from vstatics.core.cli.shared.values import named, value
from vstatics.core.errors import Problem, listed, of_file, spoken
from vstatics.core.model.transmission import Transmission
from vstatics.core.readers.named.scalars import number
from vstatics.core.readers.reading import Reading
from vstatics.synthesis.cli.case_file import case_format, write_case, written_case
from vstatics.synthesis.cli.values import pair, wrong_use
from vstatics.synthesis.ratios.fitting import (
    TOLERANCE,
    Fit,
    fitted_case,
    left_out_by_fit,
    lost_by_fit,
)
from vstatics.synthesis.ratios.fitting import fit as fitted
from vstatics.synthesis.ratios.problem import doubts, fit_problem
from vstatics.synthesis.ratios.tables import dry_document, dry_grids, fit_grids


class FitOptions(NamedTuple):
    """Wanted ratios of gears, with bounds, weights and tolerance."""

    ratios: Mapping[str, float]
    bounds: Mapping[str, tuple[float, float]]
    weights: Mapping[str, float]
    tolerance: float


@command
@gathered(
    "asked",
    FitOptions,
    click.option(
        "--ratios",
        multiple=True,
        required=True,
        metavar="GEAR=I,...",
        callback=value(named("GEAR=RATIO", number), "--ratios"),
        help="Wanted ratios of gears, such as 1=4.7,2=3.13,R=-3.3. Repeatable.",
    ),
    click.option(
        "--bounds",
        multiple=True,
        metavar="MECHANISM=LOW:HIGH,...",
        callback=value(named("MECHANISM=LOW:HIGH", pair), "--bounds"),
        help="Range of the ratio of a mechanism, or its fixed value. `all` gives the range of all "
        "other mechanisms. Repeatable.  [default: same sign as in the case, magnitude at most "
        "14; if all three links can rotate, also the same side of 1 as in the case]",
    ),
    click.option(
        "--weights",
        multiple=True,
        metavar="GEAR=W,...",
        callback=value(named("GEAR=WEIGHT", number), "--weights"),
        help="Weights of gears in the sum of squares of ln(i/wanted), with the ratio i of a gear.  "
        "[default: 1]",
    ),
    click.option(
        "--tolerance",
        type=float,
        default=TOLERANCE,
        show_default=True,
        metavar="T",
        help="Largest |ln(i/wanted)| of a ratio i that counts as met.",
    ),
)
@click.option(
    "--dry-run",
    is_flag=True,
    help="Print only the varied ratios and the possible ratios of the gears.",
)
@written_case
@one_case
def fit_command(request: OneCase, asked: FitOptions, dry_run: bool, target: str | None) -> int:
    """Fit the ratios of the mechanisms of CASE to wanted ratios of gears.

    The sum of squares of ln(i/wanted) is minimised within bounds, from many starting
    points. All different solutions are listed. The ratios keep the signs that they have in
    CASE. A ratio that the wanted ratios do not determine stays near its value in CASE. Tooth
    numbers are ignored. A gear set with shared planets has several ratios, between its
    central gears. The CASE `-` is standard input.

    \b
    Examples:
      vstatics synth fit gearbox.yaml --ratios 1=4.7,2=3.13,8=0.67
      vstatics synth fit gearbox.yaml --ratios 1=4.7 --bounds P4=-4:-3 -f json
      vstatics synth fit gearbox.yaml --ratios 1=4.7 --write fitted.yaml

    \b
    Exit status 1: a wanted ratio is not met, or the case has an error.
    Exit status 2: a gear cannot have its wanted ratio.
    """
    to = request.destination()
    form = "" if target is None else case_format(target, [request.case], to.output)

    def calculate(reading: Reading) -> CaseAnswer:
        case, file = reading.case, file_name(request.case)
        with wrong_use(FitOptions._fields):
            if dry_run:
                problem = fit_problem(case, *asked)
                notes = warnings_of("W804", doubts(problem), file)
                known = dry_document(problem)
                return CaseAnswer(lambda: dry_grids(known), known, notes)
            with progress(None, "steps", quiet=request.telling.quiet) as advance:
                result = fitted(case, **asked._asdict(), advance=advance)
        return CaseAnswer(
            lambda: fit_grids(result),
            result,
            _notes(result, file),
            failed=bool(result.unmet),
            write=lambda: target is None or _write(case, result, target, form, request.telling),
        )

    return request.answer(calculate, to)


def _write(case: Transmission, result: Fit, target: str, form: str, telling: Telling) -> bool:
    """Write the case with the new ratios; return whether the format holds all data."""
    lost = lost_by_fit(case)
    is_complete = write_case(fitted_case(case, result.ratios), target, form)
    for data in lost:
        files.say(f"{target}: not kept: {data}")
    for data in () if telling.quiet else left_out_by_fit(case, result.ratios):
        files.say(f"{target}: left out: {data}")
    return is_complete and not lost


def _notes(result: Fit, file: str) -> list[Problem]:
    notes = []
    if result.unmet:
        off = (
            "infinitely" if math.isinf(result.residual) else f"up to {100 * result.residual:.3g} %"
        )
        notes.append(of_file("E021", file, f"not met: {spoken(result.unmet)}, off by {off}"))
    warnings = [*result.warnings]
    if result.free:
        choice = f"the wanted ratios do not determine {listed(result.free)}"
        warnings.append(f"{choice}, which stay as close as possible to the case")
    return notes + warnings_of("W805", warnings, file)
