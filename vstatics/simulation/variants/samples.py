"""Variants that are drawn from the distributions which a scenario has in `samples`."""

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
"""Tables that are told of samples where they have anything."""


def sample_plan(subject: VariedScenario, options: SweepOptions) -> SweepPlan:
    """A plan of variants drawn from the distributions that a scenario has in `samples`.

    Parameters
    ----------
    subject : VariedScenario
    options : SweepOptions
        With `sample`, the number of variants, and what else a plan takes.

    Raises
    ------
    ReadError
        If the scenario has none, or one of a number that it has not.
    CaseError
        If there can be no such plan.
    """
    variations = sampled_numbers(subject)
    if not variations:
        message = "the scenario has no `samples`: distributions by the paths of numbers"
        raise ReadError([of_file("E703", subject.scenario.file, message)])
    method = cast("Method", options.method or "random")
    drawn = Sample(variations, options.sample or 1, method, options.seed or 0)
    out = options.out or Text(_of_samples(subject))
    return with_expressions(subject, replace(options, out=out), drawn)


def _of_samples(subject: VariedScenario) -> str:
    """Torques of devices are told without their sign, so that they have a mean."""
    kinds = {name: TABLES[name].kind for name in OF_SAMPLES}
    told = (name for name, kind in kinds.items() if kind == "number" or subject.rows(kind))
    return ",".join("abs(peaks)" if name == "peaks" else name for name in told)
