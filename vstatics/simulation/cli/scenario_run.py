"""Run of a scenario for commands that draw or report a case."""

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
    from vstatics.simulation.scenario.parts import Scenario

INSTANTS = 400
"""Smallest number of instants of a drawn run."""


def expect_damage(reading: Reading) -> None:
    """Raise an error if damage is requested but no life can be calculated.

    Raises
    ------
    UsageError
        If the annex that calculates damage is not installed.
    ReadError
        If the case has no fatigue strength.
    """
    if not module_of_method("expect_damage"):
        raise click.UsageError(not_installed("--damage", KEYS["fatigue"]))
    higher("expect_damage")(reading)


def run_of(outcome: CalculatedCase, out: str = "") -> Motion | None:
    """Run the scenario of a case with enough instants for pictures, and print all messages.

    Without a scenario, the result is None.

    Parameters
    ----------
    outcome : CalculatedCase
    out : str
        Additional columns, such as ``jerks[out]``.

    Raises
    ------
    ReadError
        If the run cannot start, with the places of the faults, or if a column is unknown.
    """
    from vstatics.simulation.scenario.file import ScenarioFile  # slow import, not needed for --help

    read = outcome.scenario
    if not isinstance(read, ScenarioFile):
        return None
    needs("simulation", "a run")
    from vstatics.simulation.run import simulate as simulated

    scenario = read.scenario
    columns = run_columns(out or None, scenario)
    try:
        motion = simulated(scenario, step=scenario.duration / INSTANTS, columns=columns)
    except CaseError as error:
        raise ReadError(map(read.locate, error.problems)) from None
    files.show(outcome.telling.printed(run_problems(read, motion)))
    return motion


def run_columns(out: str | None, scenario: Scenario) -> Sequence[tuple[str, str]]:
    """Return the additional columns that the text of an option names."""
    if out is None:
        return ()
    from vstatics.simulation.variants.asked import read_asked  # imports the annex `sweep`

    return read_asked(out, scenario)


def drawn_run(outcome: CalculatedCase, results: Results, out: str) -> tuple[Results, Motion | None]:
    """Return the results, renamed after the scenario, and the run (see `run_of`)."""
    motion = run_of(outcome, out)
    if outcome.scenario is None or not outcome.scenario.name:
        return results, motion
    return results._replace(case=results.case.replace(name=outcome.scenario.name)), motion


def run_problems(read: ScenarioFile, motion: Motion) -> Iterator[Problem]:
    """Yield the messages of a scenario and its run, and the reason for an early stop, with places.

    A note of the scenario is omitted if the run gives the same note.
    """
    repeated = {message.id for message in motion.messages}
    yield from (doubt for doubt in read.doubts if doubt.id not in repeated)
    file = read.spots.place(())._replace(line=0, column=0, text="")
    for message in motion.messages:
        text = f"gear {message.gear}: {message.text}" if message.gear else message.text
        yield Problem(message.id, text, (), file)
    if motion.stopped is not None:
        yield read.locate(motion.stopped)
