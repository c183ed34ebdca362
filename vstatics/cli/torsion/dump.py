"""`vstatics torsion dump`: the largest torque when the clutch is dumped, in closed form."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial

import click

from vstatics.cli.frame import cases as arguments
from vstatics.cli.frame import files
from vstatics.cli.frame.exit_status import DONE
from vstatics.cli.frame.one_case import CaseAnswer, OneCase, of_case, show
from vstatics.cli.frame.options import gathered
from vstatics.cli.frame.values import value
from vstatics.cli.torsion.case import gear_names, located
from vstatics.readers.reading import Reading
from vstatics.torsion.clutch.document import (
    FORMAT,
    VERSION,
    dump_document,
    gear_document,
    gears_document,
)
from vstatics.torsion.clutch.dumped import DumpTorque
from vstatics.torsion.clutch.engagement import Engagement
from vstatics.torsion.clutch.given import Dump
from vstatics.writers.documents import documents, head
from vstatics.writers.record_schema import TEXT, Schema, list_of, record, schema_of


def _rate(given: float) -> float:
    if not 0 < given < math.inf:
        raise ValueError(f"{given:g} is no rate, expected one above 0")
    return given


@click.command()
@click.option(
    "--rate",
    type=float,
    callback=value(_rate),
    metavar="K",
    help="Also the dynamic factor of a clutch whose torque grows as 1 - exp(-K t), in 1/s.",
)
@arguments.some_gears
@gathered("one", OneCase, click.argument("case", type=click.Path(), metavar="FILE"), *of_case)
def dump(one: OneCase, rate: float | None, gears: tuple[str, ...]) -> int:
    """Tell the largest torque when the clutch is dumped; - is standard input.

    FILE is YAML with inertias on one shaft, J1 (engine), J2 (disc), J3 (transmission),
    J4 (wheels), J5 (vehicle), the compliance E between J3 and J4, the torques M_C0 at
    which the clutch and M_phi at which the tyres break away, and omega1, the speed of
    the engine before: in kg*m^2, rad/(N*m), N*m and rad/s, or in any one system of
    relative units. `J4: .inf` is for clamped wheels, `M_phi: .inf` for tyres that
    always grip.

    Or FILE is a case with inertias, springs and `dump`, where J1 to J5 are lists of its
    links. Numbers are those of the links: M_C0 on the first of J2, omega1 of the first of
    J1, M_phi on the first of J4, of all wheels together. In each gear all is reduced to
    the link `to`, else the first of J2, and so are the torques that are told. E is the
    compliance from J2 to J5 held, by all that is elastic on the way.

    The formulas are those of Tsitovich and Algin (1981). Cases A: the clutch slips; B:
    it grabs; V: it grabs and breaks away again.

    \b
    Examples:
      vstatics torsion dump dump.yaml
      vstatics torsion dump dump.yaml --rate 50 -f json | jq .max_torque
      vstatics torsion dump box.yaml --gear 1

    \b
    \b
    Exit status: 0 done; 1 the file is in error, or a gear has no such torque;
    2 wrong use.
    """
    to = one.destination()
    from vstatics.torsion.clutch.file import is_of_case, read_dump

    read = data, name = files.read_input(one.case)
    if one.input_format == "deck" or is_of_case(data, name):
        return one.answer(partial(_of_case, gears, rate), to, "torsion", read)
    if gears:
        raise click.UsageError(f"--gear is for a case, but {name} has numbers alone")
    from vstatics.torsion.clutch.grids import grids

    numbers = read_dump(data, name)
    made = numbers.torque(rate)
    shown = CaseAnswer(lambda: grids(numbers.given, made), lambda: dump_document(made))
    show(one.case, to, name, shown)
    return DONE


def _of_case(gears: Sequence[str], rate: float | None, reading: Reading) -> CaseAnswer:
    """The gears of a case; one that is asked for alone is shown as a file of numbers is."""
    from vstatics.torsion.clutch.gear_dump import gear_dumps
    from vstatics.torsion.clutch.grids import gear_grids, gears_grids

    found = gear_dumps(reading.case, gear_names(reading.case, gears), rate)
    faults = located(reading, ((gear.name, gear.error) for gear in found))
    alone = bool(gears) and len(found) == 1
    return CaseAnswer(
        lambda: gear_grids(found[0]) if alone else gears_grids(found),
        lambda: gear_document(found[0]) if alone else gears_document(found),
        faults,
        failed=bool(faults),
    )


def json_schema() -> Schema:
    """The schema of ``vstatics torsion dump -f json``: of numbers, of a gear, of several."""
    torques = schema_of(DumpTorque, engagement=schema_of(Engagement), messages=list_of(TEXT))
    in_gear = {"name": TEXT, "to": TEXT, "reduced": schema_of(Dump)}
    one = {**torques["properties"], **in_gear}
    needed = [name for name in torques["properties"] if name != "engagement"]
    failed = record({"name": TEXT, "error": TEXT})
    of_gear = record(one, optional=["engagement"])
    gears = list_of({"if": {"required": ["error"]}, "then": failed, "else": of_gear})
    start = head(FORMAT, VERSION)
    properties = {**start, **one, "error": TEXT, "gears": gears}
    forms = [["gears"], ["name", "error"], needed, [*needed, *in_gear]]
    document = {
        "type": "object",
        "properties": properties,
        "required": [*start],
        "additionalProperties": False,
        "oneOf": [_exactly(form, properties, [*start, "file", "engagement"]) for form in forms],
    }
    return documents("dump", "A clutch that is dumped, of vstatics torsion dump", document)


def _exactly(form: Sequence[str], properties: Schema, free: Sequence[str]) -> Schema:
    """These keys, and none of the others but those that are free."""
    others = [name for name in properties if name not in {*form, *free}]
    return {"required": [*form], "properties": dict.fromkeys(others, False)}
