"""`vstatics torsion dump`: the largest torque when the clutch is dumped, in closed form."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

import click

from vstatics.cli import files, formats, texts
from vstatics.cli.cases import CalculatedCase
from vstatics.cli.exit_status import DONE
from vstatics.cli.formats import OutputOptions
from vstatics.tables.grid import Grid
from vstatics.torsion.dump import DumpTorque
from vstatics.torsion.dump_given import Dump
from vstatics.torsion.engagement import Engagement
from vstatics.writers.documents import documents, head
from vstatics.writers.plain_json import plain_data
from vstatics.writers.record_schema import TEXT, Schema, list_of, record, schema_of

FORMAT, VERSION = "vstatics-dump", 1


def _rate(context: click.Context, parameter: click.Parameter, value: float | None) -> float | None:
    if value is not None and not 0 < value < math.inf:
        raise click.BadParameter(f"{value:g} is no rate, expected one above 0", context, parameter)
    return value


@click.command()
@click.argument("file", type=click.Path(), metavar="FILE")
@click.option(
    "--rate",
    type=float,
    callback=_rate,
    metavar="K",
    help="Also the dynamic factor of a clutch whose torque grows as 1 - exp(-K t), in 1/s.",
)
@formats.options(*formats.TABLES)
def dump(file: str, rate: float | None, wanted: OutputOptions) -> int:
    """Tell the largest torque when the clutch is dumped; - is standard input.

    FILE is YAML with inertias on one shaft, J1 (engine), J2 (disc), J3 (transmission),
    J4 (wheels), J5 (vehicle), the compliance E between J3 and J4, the torques M_C0 at
    which the clutch and M_phi at which the tyres break away, and omega1, the speed of
    the engine before: in kg*m^2, rad/(N*m), N*m and rad/s, or in any one system of
    relative units. `J4: .inf` is for clamped wheels, `M_phi: .inf` for tyres that
    always grip.

    The formulas are those of Tsitovich and Algin (1981). Cases A: the clutch slips; B:
    it grabs; V: it grabs and breaks away again.

    \b
    Examples:
      vstatics torsion dump dump.yaml
      vstatics torsion dump dump.yaml --rate 50 -f json | jq .max_torque

    Exit status: 0 done; 1 the file is in error; 2 wrong use.
    """
    to = wanted.destination([file])
    if to.is_folder:
        raise click.UsageError(f"one file gives one text: expected -o FILE, not {to.output}")
    from vstatics.torsion.dump_file import read_dump

    data, name = files.read_input(file)
    read = read_dump(data, name)
    form = texts.OutputForm(to.form, to.style)
    shown = output(name, read.given, read.torque(rate))
    files.write_data(texts.alone(CalculatedCase(name, None, []), shown, form), to.output)
    return DONE


def output(title: str, given: Dump, made: DumpTorque) -> texts.CaseOutput:
    """What there is to show of a clutch that is dumped."""

    def tables() -> Iterable[Grid]:
        from vstatics.torsion.dump_grids import grids

        return grids(given, made)

    return texts.CaseOutput([title], {}, tables, lambda: document(made))


def document(made: DumpTorque) -> dict[str, Any]:
    """The largest torques as plain data."""
    values = {**made._asdict(), "messages": list(map(str, made.messages))}
    if made.engagement is None:
        del values["engagement"]
    plain: dict[str, Any] = plain_data({"format": FORMAT, "version": VERSION, **values})
    return plain


def json_schema() -> Schema:
    """The schema of ``vstatics torsion dump -f json``."""
    texts_ = list_of(TEXT)
    values = schema_of(DumpTorque, engagement=schema_of(Engagement), messages=texts_)
    properties = {**head(FORMAT, VERSION), **values["properties"]}
    one = record(properties, optional=["engagement"])
    return documents("dump", "A clutch that is dumped, of vstatics torsion dump", one)
