"""`vstatics damage CASE RECORD.csv`: the damage of devices by a record of their torques."""

from __future__ import annotations

import click

from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.cases import check_order
from vstatics.core.cli.shared.one_case import CaseAnswer, OneCase, of_case
from vstatics.core.cli.shared.options import gathered
from vstatics.core.jobs.input_files import TABLE_BYTES
from vstatics.core.readers.reading import Reading
from vstatics.vehicle.cli.strengths import expect_damage


@click.command()
@gathered("single", OneCase, click.argument("case", type=click.Path()), *of_case)
@click.argument("recorded", type=click.Path(), metavar="RECORD.csv")
def record(single: OneCase, recorded: str) -> int:
    """Add up what a record of torques does to the devices of CASE that have `fatigue`.

    RECORD.csv has a column `torques[DEVICE]` for each, in N*m or in the unit that stands
    behind it in brackets, as `vstatics simulate -o` writes it; - is standard input. Cycles
    are counted by rainflow (ASTM E1049-85, 5.4.4), damages are added up.

    \b
    Examples:
      vstatics damage box.yaml record.csv
      vstatics damage box.yaml record.csv -f json | jq .damage.shaft.repeats

    \b
    Exit status: 0 done; 1 the case or the record is in error; 2 wrong use.
    """
    to = single.destination(recorded)
    check_order(single.case, recorded)

    def calculate(reading: Reading) -> CaseAnswer:
        from vstatics.vehicle.damage.devices import DamageAnswer
        from vstatics.vehicle.damage.recorded import recorded_damage
        from vstatics.vehicle.damage.tables import damage_grid

        case = reading.case
        expect_damage(reading)
        result = recorded_damage(case, *files.read_input(recorded, TABLE_BYTES))
        answer = DamageAnswer(case.name, result.damage)
        return CaseAnswer(lambda: [damage_grid(result.damage)], answer, result.warnings)

    return single.answer(calculate, to)
