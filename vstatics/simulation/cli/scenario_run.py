"""The run of a scenario that stands for its case, for pictures and pages."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import click

from vstatics.core.annexes import KEYS, module_of_method, not_installed
from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.cases import CalculatedCase
from vstatics.core.cli.shared.options import needs
from vstatics.core.errors import CaseError, Problem, ReadError
from vstatics.core.extras import higher

if TYPE_CHECKING:
    from vstatics.core.readers.reading import Reading
    from vstatics.core.statics.results import Results
    from vstatics.simulation.record.motion import Motion
    from vstatics.simulation.scenario.file import ScenarioFile

INSTANTS = 400
"""Of a run that is drawn, at least."""


def expect_damage(reading: Reading) -> None:
    """Refuse to report damage if no life can be calculated.

    Raises
    ------
    UsageError
        If the annex that calculates it is not installed.
    ReadError
        If the case has no fatigue strength.
    """
    if not module_of_method("expect_damage"):
        raise click.UsageError(not_installed("--damage", KEYS["fatigue"]))
    higher("expect_damage")(reading)


def run_of(outcome: CalculatedCase, out: str = "") -> Motion | None:
    """The run of what names its case by a scenario, with enough instants for pictures.

    What is to be said of it is printed.

    Parameters
    ----------
    outcome : CalculatedCase
    out : str
        Columns that it is to have besides, such as ``jerks[out]``.

    Raises
    ------
    ReadError
        If it can't begin, with the places of what keeps it from that; of columns that are not.
    """
    from vstatics.simulation.scenario.file import ScenarioFile  # needless for help

    read = outcome.scenario
    if not isinstance(read, ScenarioFile):
        return None
    needs("simulation", "a run")
    from vstatics.simulation.run import simulate as simulated

    scenario = read.scenario
    columns: Sequence[tuple[str, str]] = ()
    if out:
        from vstatics.simulation.variants.asked import read_asked  # it takes the annex `sweep`

        columns = read_asked(out, scenario)
    try:
        motion = simulated(scenario, step=scenario.duration / INSTANTS, columns=columns)
    except CaseError as error:
        raise ReadError(map(read.locate, error.problems)) from None
    files.show(outcome.telling.printed(run_problems(read, motion)))
    return motion


def drawn_run(outcome: CalculatedCase, results: Results, out: str) -> tuple[Results, Motion | None]:
    """Return results with the name of their scenario, for pictures, and its run as of `run_of`."""
    motion = run_of(outcome, out)
    if outcome.scenario is None or not outcome.scenario.name:
        return results, motion
    return results._replace(case=results.case.replace(name=outcome.scenario.name)), motion


def run_problems(read: ScenarioFile, motion: Motion) -> Iterator[Problem]:
    """Messages of a run, and why it stopped, at their places."""
    file = read.spots.place(())._replace(line=0, column=0, text="")
    for message in motion.messages:
        text = f"gear {message.gear}: {message.text}" if message.gear else message.text
        yield Problem(message.id, text, (), file)
    if motion.stopped is not None:
        yield read.locate(motion.stopped)
