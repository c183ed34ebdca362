"""`vstatics torsion dump`: the largest torque when the clutch is dumped, in closed form."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial

import click

from vstatics.core.cli.shared import cases as arguments
from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.exit_status import DONE
from vstatics.core.cli.shared.one_case import CaseAnswer, OneCase, of_case, show
from vstatics.core.cli.shared.options import command, gathered
from vstatics.core.cli.shared.values import FILE, value
from vstatics.core.readers.reading import Reading
from vstatics.core.tables.answer import Schema, documents, head_schema, list_of, schema
from vstatics.torsion.cli.case import gear_names, gears_answer, slope_notes, static_torque
from vstatics.torsion.clutch.dumped import DUMP_FORM, DumpAnswer, DumpTorque


def _rate(given: float) -> float:
    if not 0 < given < math.inf:
        raise ValueError(f"{given:g} is not a rate, expected a rate above 0")
    return given


@command
@click.option(
    "--rate",
    type=float,
    callback=value(_rate),
    metavar="K",
    help="Add the dynamic factor of a clutch torque that grows with 1 - exp(-K t); K in 1/s.",
)
@arguments.some_gears
@gathered(
    "request",
    OneCase,
    click.argument("case", type=FILE, metavar="FILE"),
    *of_case,
    static_torque,
)
def dump_command(request: OneCase, rate: float | None, gears: tuple[str, ...]) -> int:
    """Calculate the largest torque when the clutch is dumped; `-` is standard input.

    FILE is a YAML file with a system on one shaft:

    \b
      J1 to J5  inertias of engine, disc, transmission, wheels and vehicle;
                `J4: .inf` fixes the wheels
      E         compliance between J3 and J4
      M_C0      torque at which the sticking clutch begins to slip
      M_phi     torque at which the tyres begin to slip; `M_phi: .inf` for tyres
                that always grip
      omega1    initial speed of the engine

    The units are kg*m^2, rad/(N*m), N*m and rad/s, or any consistent relative units.

    FILE can also be a case with inertias, springs and the key `dump`, in which J1 to J5 are
    lists of links. M_C0 then acts on the first link of J2, M_phi on the first link of J4 for
    all wheels together, and omega1 is the speed of the first link of J1. In each gear, the
    system is reduced to the link `to` (default: the first link of J2), and so are the
    resulting torques. E is the compliance of all springs from J2 to the fixed J5.

    The formulas are from Tsitovich and Algin (1981). Case A: the clutch slips; B: it sticks
    (grabs); V: it sticks and slips again.

    \b
    Examples:
      vstatics new car.yaml --template moskvich412
      vstatics torsion dump car.yaml --gear 1
      echo '{J1: 0.15, J2: 0.005, J3: 0.01, J4: 0.1, J5: 5, E: 1e-3,
        M_C0: 180, M_phi: 900, omega1: 600}' > dump.yaml
      vstatics torsion dump dump.yaml
      vstatics torsion dump dump.yaml --rate 50 -f json | jq .max_torque

    Exit status 1: the file has an error, or a gear has no such torque.
    """
    to = request.destination()
    from vstatics.torsion.clutch.file import is_of_case, read_dump

    read = data, name = files.read_input(request.case)
    if request.input_format == "deck" or is_of_case(data, name):
        return request.answer(partial(_of_case, gears, rate), to, "torsion", read)
    if gears:
        raise click.UsageError(f"--gear is for a case, but {name} has numbers alone")
    if request.static_torque is not None:
        raise click.UsageError(f"--torque is for a case, but {name} has numbers alone")
    from vstatics.torsion.clutch.tables import grids

    numbers = read_dump(data, name)
    torque = numbers.torque(rate)
    show(request.case, to, name, CaseAnswer(lambda: grids(torque), DumpAnswer(torque)))
    return DONE


def _of_case(gears: Sequence[str], rate: float | None, reading: Reading) -> CaseAnswer:
    """Return the answer for gears of a case, with more details if a single gear is chosen."""
    from vstatics.torsion.clutch.gear_dump import GearDumpAnswer, GearsDumpAnswer, gear_dumps
    from vstatics.torsion.clutch.tables import gear_grids, gears_grids

    dumps = gear_dumps(reading.case, gear_names(reading.case, gears), rate)
    notes = slope_notes(reading, [gear.name for gear in dumps])
    is_single = bool(gears) and len(dumps) == 1
    return gears_answer(
        reading,
        dumps,
        lambda: gear_grids(dumps[0]) if is_single else gears_grids(dumps),
        GearDumpAnswer(dumps[0]) if is_single else GearsDumpAnswer(dumps),
        notes,
    )


def json_schema() -> Schema:
    """Return the JSON schema of answers of ``vstatics torsion dump``, for numbers or gears."""
    from vstatics.torsion.clutch.gear_dump import GearDump

    of_gear, torques = schema(GearDump), schema(DumpTorque)["required"]
    start = head_schema(DUMP_FORM)
    failed, successful = of_gear["then"], of_gear["else"]
    properties = (
        start | successful["properties"] | failed["properties"] | {"gears": list_of(of_gear)}
    )
    free = [*start, "file", "engagement"]
    forms = (["gears"], failed["required"], torques, successful["required"])
    document = {
        "type": "object",
        "properties": properties,
        "required": [*start],
        "additionalProperties": False,
        "oneOf": [_exactly(form, properties, free) for form in forms],
    }
    return documents("dump", "A clutch that is dumped, of vstatics torsion dump", document)


def _exactly(form: Sequence[str], properties: Schema, free: Sequence[str]) -> Schema:
    """Return a schema that requires the keys in `form` and allows no others except `free`."""
    others = [name for name in properties if name not in {*form, *free}]
    return {"required": [*form], "properties": dict.fromkeys(others, False)}
