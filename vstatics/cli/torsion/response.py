"""`vstatics torsion response`: amplitudes and torques under harmonic torques."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import click

from vstatics import readers
from vstatics.cli.frame import cases as arguments
from vstatics.cli.frame import files, formats
from vstatics.cli.frame.exit_status import DONE, FAILED
from vstatics.cli.frame.formats import FULL, OutputOptions
from vstatics.cli.frame.one_case import one_text, show, tell
from vstatics.cli.frame.problems import Telling
from vstatics.cli.torsion.case import coasting, gear_names, link_name, located, needs_scipy

if TYPE_CHECKING:
    from vstatics.numerics.arrays import Floats
    from vstatics.torsion.forced.harmonic_torques import Harmonic

MOST_SPEEDS = 100_000


@click.command()
@click.argument("case", type=click.Path())
@click.option(
    "--at", required=True, metavar="LINK", help="The link on which the torque acts, by its name."
)
@click.option(
    "--orders",
    metavar="N,...",
    help="Orders, by revolutions of LINK: 1 N*m each, or those of the table that count.",
)
@click.option(
    "--speed",
    required=True,
    metavar="A:B:N",
    help="Speeds of LINK in rpm: N of them from A to B, or a list with commas.",
)
@click.option(
    "--torque",
    type=click.Path(),
    metavar="FILE",
    help="CSV with the columns order, amplitude [N*m] and phase [rad] or `phase [deg]`.",
)
@click.option(
    "--sum",
    "with_sum",
    is_flag=True,
    help="All orders together: the largest value over a cycle, and the RMS.",
)
@arguments.some_gears
@formats.options(*formats.TABLES)
@arguments.input_format
@arguments.coast
@arguments.telling
def response(
    case: str,
    at: str,
    orders: str | None,
    speed: str,
    torque: str | None,
    with_sum: bool,
    gears: tuple[str, ...],
    wanted: OutputOptions,
    input_format: readers.Format | None,
    coast: bool | None,
    telling: Telling,
) -> int:
    """Calculate the forced vibration of CASE in every gear; - is standard input.

    A harmonic torque acts on LINK. For each order: amplitudes of links [rad] and torques
    of devices [N*m] over the speeds, and where an order meets a natural frequency. Text
    shows the largest values, CSV, XLSX and JSON all. There is no value where an undamped
    system is hit exactly.

    \b
    Examples:
      vstatics torsion response box.yaml --at engine --orders 2 --speed 600:3000:9
      vstatics torsion response box.yaml --at engine --torque m.csv --speed 900

    \b
    Exit status: 0 done; 1 the case is in error or a gear is tied up; 2 wrong use.
    """
    inputs = [case, *([torque] if torque else [])]
    arguments.check_streams(inputs)
    to = one_text(wanted, inputs)
    needs_scipy()
    from vstatics.torsion.documents import response_document
    from vstatics.torsion.forced.grids import largest_grids, speed_grids, sum_grids
    from vstatics.torsion.forced.harmonic_torques import response as responses

    harmonics, speeds = _harmonics(orders, torque), _speeds(speed)
    reading = coasting(arguments.read_one(case, input_format, telling), coast)
    link = link_name(reading.case, at, "--at")
    found = responses(reading.case, link, harmonics, speeds, gear_names(reading.case, gears))
    faults = list(located(reading, [(one.name, "error", one.error) for one in found if one.error]))
    tell(faults, telling, case)
    name = reading.case.name
    grids = speed_grids if to.form in (*FULL, "xlsx") else largest_grids
    show(
        case,
        to,
        name,
        lambda: [*grids(found), *(sum_grids(found) if with_sum else ())],
        lambda: response_document(name, link, found, with_sum=with_sum),
    )
    return FAILED if faults or telling.fails(reading.warnings) else DONE


def _harmonics(orders: str | None, torque: str | None) -> list[Harmonic]:
    """What excites: by the table, or of 1 N*m."""
    from vstatics.torsion.forced.harmonic_torques import Harmonic
    from vstatics.torsion.forced.torque_table import read_torque_table

    asked = None if orders is None else _numbers(orders, "--orders", "an order above 0")
    if torque is None:
        if asked is None:
            raise click.UsageError("expected --orders, --torque or both")
        return [Harmonic(order) for order in dict.fromkeys(asked)]
    found = read_torque_table(*files.read_input(torque))
    if asked is None:
        return found
    by_order = {one.order: one for one in found}
    for order in asked:
        if order not in by_order:
            known = ", ".join(f"{one:g}" for one in by_order)
            message = f"{torque} has no order {order:g}; it has {known}"
            raise click.BadParameter(message, param_hint="--orders")
    return [by_order[order] for order in dict.fromkeys(asked)]


def _speeds(text: str) -> Floats:
    """Speeds [rpm] from A:B:N, or a list."""
    import numpy as np

    from vstatics.sweep.variants.steps import Steps

    parts = text.split(":")
    if len(parts) != 3:
        return np.array(_numbers(text, "--speed", "a speed of 0 or more, or A:B:N", least=0.0))
    first, last = _numbers(",".join(parts[:2]), "--speed", "a speed of 0 or more", least=0.0)
    count = parts[2].strip()
    if not (count.isascii() and count.isdigit() and 1 < int(count[:9]) <= MOST_SPEEDS):
        message = f"read {count[:20]!r}, expected how many speeds, from 2 to {MOST_SPEEDS}"
        raise click.BadParameter(message, param_hint="--speed")
    return Steps(first, last, int(count))[np.arange(int(count))]


def _numbers(
    text: str, option: str, expected: str, least: float = math.ulp(0.0)
) -> Sequence[float]:
    found = []
    for part in text.split(","):
        try:
            value = float(part)
        except ValueError:
            value = math.nan
        if not least <= value < math.inf:
            raise click.BadParameter(f"read {part[:20]!r}, expected {expected}", param_hint=option)
        found.append(value)
    return found
