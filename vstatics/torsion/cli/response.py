"""Command `vstatics torsion response`: amplitudes and torques under harmonic torques."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import click

from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.one_case import CaseAnswer, OneCase
from vstatics.core.cli.shared.options import command, gathered
from vstatics.core.cli.shared.values import FILE, numbers, told, value
from vstatics.core.errors import listed, plural, spoken
from vstatics.core.readers.reading import Reading
from vstatics.torsion.cli.case import (
    CASE_OPTIONS,
    WorkingGears,
    gears_answer,
    link_name,
    located,
    working_notes,
    working_options,
)

if TYPE_CHECKING:
    from vstatics.core.model.transmission import Transmission
    from vstatics.core.numerics.arrays import Floats
    from vstatics.pictures.drawing.style import PictureFiles
    from vstatics.torsion.forced.harmonic_torques import GearResponse, Harmonic
    from vstatics.torsion.system.working_points import WorkingGear

MOST_SPEEDS = 100_000
"""Largest number of speeds in a range A:B:N."""


def speeds_of(text: str) -> Floats:
    """Read a list of numbers, or a range A:B:N of N numbers from A to B."""
    import numpy as np

    from vstatics.core.numerics.steps import Steps

    parts = text.split(":")
    if len(parts) not in (2, 3):
        return np.array(numbers("a speed of 0 or more, or A:B:N")(text))
    first, last = numbers("a speed of 0 or more")(",".join(parts[:2]))
    count = "".join(parts[2:]).strip()
    if not (count.isascii() and count.isdigit() and 1 < int(count[:9]) <= MOST_SPEEDS):
        expected = f"A:B:N with 2 to {MOST_SPEEDS} speeds, such as 600:1000:9"
        raise ValueError(f"read {text[:40]!r}, expected {expected}")
    return Steps(first, last, int(count))[np.arange(int(count))]


def _rpm(text: str) -> Floats:
    """Read speeds in rpm from a list or range, with or without units."""
    from vstatics.core.readers.named.units import common_unit, quantity

    bare, unit = common_unit(text)
    if unit and text.count(unit) != len(bare.split(":")[:2] if ":" in bare else bare.split(",")):
        raise ValueError(f"read speeds with and without {unit}, expected a unit for each speed")
    return speeds_of(bare) * (
        told(lambda text: quantity(f"1 {text}", "speed"))(unit) if unit else 1
    )


class Exciting(NamedTuple):
    """Exciting torque: orders of 1 N*m, a table, or some orders of a table."""

    orders: Sequence[float] | None = None
    torque: str | None = None
    """Name of a file with a table of harmonics."""

    def harmonics(self, firing: float = 0) -> list[Harmonic]:
        """Return the chosen harmonics of the table, or the given orders with 1 N*m each.

        `firing` is the order without a table and given orders; 0 if unknown.

        Raises
        ------
        UsageError
            If no order is known, or if the table does not contain a given order.
        """
        from vstatics.torsion.forced.harmonic_torques import Harmonic
        from vstatics.torsion.forced.torque_table import read_torque_table

        if self.torque is None:
            orders = self.orders or [firing]
            if 0 in orders:
                raise click.UsageError("expected --orders, --torque or both")
            return [Harmonic(order) for order in dict.fromkeys(orders)]
        by_order = {
            harmonic.order: harmonic
            for harmonic in read_torque_table(*files.read_input(self.torque))
        }
        chosen = dict.fromkeys(self.orders or by_order)
        for order in chosen:
            if order not in by_order:
                known = ", ".join(map("{:g}".format, by_order))
                message = f"{self.torque} has no order {order:g}; it has {known}"
                raise click.BadParameter(message, param_hint="--orders")
        return [by_order[order] for order in chosen]


def drawn_torques(asked: PictureFiles) -> list[Harmonic]:
    """Return the harmonics of the torque in a file for a picture; empty without a file.

    Raises
    ------
    ReadError
        If the table is not valid.
    """
    return Exciting(torque=asked.torque).harmonics() if asked.torque else []


def _input_of(gears: Sequence[WorkingGear]) -> str:
    """Return the name of the input link that all gears have in common.

    Raises
    ------
    UsageError
        If gears have different inputs.
    """
    inputs = dict.fromkeys(case.link_name(case.gear_input(gear)) for case, gear, *_ in gears)
    if len(inputs) > 1:
        raise click.UsageError(f"Missing option '--at': gears have the inputs {listed([*inputs])}")
    return next(iter(inputs))


def _unbounded(case: Transmission, gear: GearResponse) -> str:
    """Return a note on undamped resonances, or an empty text."""
    speeds = [f"{r.speed:.6g}" for r in gear.resonances if not r.damped]
    if not speeds:
        return ""
    names = f"{plural('resonance', len(speeds))} at {listed(speeds)} rpm"
    near = f"damps the {names}: the response near {'them' if speeds[1:] else 'it'} is unbounded"
    if any(spring.friction for spring in case.springs):
        near = f"but dry friction {near} where the torque exceeds 4 M/pi of the friction"
    return f"nothing {near}, and the largest values are those at the requested speeds"


def _stuck_springs(case: Transmission, gear: GearResponse) -> str:
    """Return a note on springs that dry friction keeps from twisting, or an empty text.

    A spring slides only if its torque is at least ``4 M/pi``, with its friction M.
    """
    import numpy as np

    from vstatics.torsion.forced.dry_friction import sliding_torque
    from vstatics.torsion.tolerances import STUCK_TORQUE

    notes = []
    for order in gear.orders:
        for spring in case.springs:
            torques = np.abs(order.torques.get(spring.name, np.zeros(0)))
            limit = sliding_torque(spring) * (1 - STUCK_TORQUE)
            if count := int((torques < limit).sum()):
                notes.append(f"{spring.name} in order {order.order:g} at {count} of {len(torques)}")
    return f"stuck by dry friction, with amplitude 0: {spoken(notes)} speeds" if notes else ""


@command
@click.option(
    "--at",
    metavar="LINK",
    help="Link on which the torque acts, by its name.  [default: input]",
)
@gathered(
    "exciting",
    Exciting,
    click.option(
        "--orders",
        metavar="N,...",
        callback=value(numbers("an order above 0", math.ulp(0.0)), "--orders"),
        help="Orders per revolution of LINK, each with a torque of 1 N*m. If --torque is given: "
        "orders to select from its table (default: all). If neither --torque nor --at is given, "
        "the default is half the `cylinders` of the case.",
    ),
    click.option(
        "--speed",
        required=True,
        metavar="A:B:N",
        callback=value(_rpm, "--speed"),
        help="Speeds of LINK, in rpm or with a unit: N speeds from A to B, or a list.",
    ),
    click.option(
        "--torque",
        type=FILE,
        metavar="FILE",
        help="CSV file with the columns `order`, `amplitude [N*m]`, `phase [rad]` or `phase "
        "[deg]`, and `link` for torques on several links.",
    ),
)
@click.option(
    "--sum",
    "with_sum",
    is_flag=True,
    help="Add the sum of all orders: the largest value during a cycle, and the RMS value.",
)
@working_options()
@gathered("request", OneCase, *CASE_OPTIONS)
def response_command(
    request: OneCase,
    at: str | None,
    exciting: Exciting,
    speed: Floats,
    with_sum: bool,
    chosen: WorkingGears,
) -> int:
    """Calculate the forced vibration of CASE in every gear; `-` is standard input.

    A harmonic torque acts on LINK. For each order and speed you get the amplitudes of the
    links [rad] and the torques of the components [N*m]. The speeds at which an order
    coincides with a natural frequency of LINK are added. Springs with `points` and
    converters have their slopes at the operating point of CASE.

    Dry friction M of a spring counts as a damper of 4 M/(pi A w), with the amplitude A of the
    twist and the frequency w. Below an amplitude of 4 M/pi, a torque does
    not twist the spring.

    Text shows the largest values. CSV, XLSX and JSON contain all values. An undamped system
    has no value exactly at its natural frequency.

    \b
    Examples:
      vstatics new car.yaml --template moskvich412
      vstatics torsion response car.yaml --orders 2 --speed 600:3000:9
      printf 'order,amplitude [N*m],phase [rad]\\n2,150,0\\n4,40,0.5\\n' > engine.csv
      vstatics torsion response car.yaml --at engine \\
          --torque engine.csv --speed 900

    Exit status 1: the case has an error, or a gear has no response.
    """
    to = request.destination(*filter(None, [exciting.torque]))

    def calculate(reading: Reading) -> CaseAnswer:
        from vstatics.torsion.answers import ResponseAnswer
        from vstatics.torsion.forced.harmonic_torques import response as calculate_response
        from vstatics.torsion.forced.tables import largest_grids, row_grids, speed_grids, sum_grids

        case = reading.case
        working = chosen.of(case)
        link = _input_of(working) if at is None else link_name(case, at, "--at")
        gears = calculate_response(
            case,
            link,
            exciting.harmonics(0 if at else (case.cylinders or 0) / 2),
            speed,
            [at_point.gear.name for at_point in working],
            speed_ratios=chosen.ratios,
        )
        if with_sum:
            gears = [gear.with_sum() for gear in gears]
        notes = [
            *working_notes(reading, working, linearised=True),
            *located(reading, ((gear.name, _stuck_springs(case, gear)) for gear in gears), "N509"),
            *located(reading, ((gear.name, _unbounded(case, gear)) for gear in gears), "N630"),
        ]
        grids = speed_grids if to.form == "xlsx" else largest_grids
        return gears_answer(
            reading,
            gears,
            lambda: row_grids(gears) if to.form == "csv" else [*grids(gears), *sum_grids(gears)],
            ResponseAnswer(case.name, link, gears),
            notes,
        )

    return request.answer(calculate, to, extra="torsion")
