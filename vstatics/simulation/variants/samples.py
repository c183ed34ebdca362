"""Variants drawn from the distributions under `samples` in a scenario."""

from __future__ import annotations

from dataclasses import replace
from typing import cast

from vstatics.core.errors import ReadError, of_file
from vstatics.simulation.variants.motion_tables import TABLES
from vstatics.simulation.variants.numbers import sampled_numbers
from vstatics.simulation.variants.subject import VariedScenario
from vstatics.sweep.build import with_expressions
from vstatics.sweep.options import SweepOptions, Text
from vstatics.sweep.plan import SweepPlan
from vstatics.sweep.variants.samples import Method, Sample

OF_SAMPLES = ("peaks", "heat", "losses", "locks", "damage", "work", "kinetic", "elastic", "impact")
"""Default tables of results for samples; empty tables are left out."""


def sample_plan(subject: VariedScenario, options: SweepOptions) -> SweepPlan:
    """Return a plan of variants drawn from the distributions under `samples`.

    Parameters
    ----------
    subject : VariedScenario
    options : SweepOptions
        Options of the plan; `sample` is the number of variants.

    Raises
    ------
    ReadError
        If the scenario has no distributions, or a distribution for an unknown number.
    CaseError
        If the options contradict each other.
    """
    variations = sampled_numbers(subject)
    if not variations:
        raise ReadError(
            [
                of_file(
                    "E703",
                    subject.scenario.file,
                    "the scenario has no `samples`: give distributions by the paths of numbers",
                )
            ]
        )
    method = cast("Method", options.method or "random")
    drawn = Sample(variations, options.sample or 1, method, options.seed or 0)
    kinds = {name: TABLES[name].kind for name in OF_SAMPLES}
    names = [name for name, kind in kinds.items() if kind == "number" or subject.rows(kind)]
    # the magnitudes of peaks are averaged
    columns = ["abs(peaks)" if name == "peaks" else name for name in names]
    out = options.out or Text(",".join(columns))
    return with_expressions(subject, replace(options, out=out), drawn)
