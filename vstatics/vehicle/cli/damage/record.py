"""Command `vstatics damage CASE RECORD.csv`: damage of components by a record of their torques."""

from __future__ import annotations

import click

from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.cases import check_order
from vstatics.core.cli.shared.one_case import CaseAnswer, OneCase, of_case
from vstatics.core.cli.shared.options import command, gathered
from vstatics.core.cli.shared.values import FILE
from vstatics.core.jobs.input_files import TABLE_BYTES
from vstatics.core.readers.reading import Reading
from vstatics.vehicle.cli.strengths import expect_damage


@command
@gathered("single", OneCase, click.argument("case", type=FILE), *of_case)
@click.argument("recorded", type=FILE, metavar="RECORD.csv")
def record_command(single: OneCase, recorded: str) -> int:
    """Calculate the fatigue damage of the components of CASE under recorded torques.

    RECORD.csv has a column `torques[COMPONENT]` for each component of CASE with `fatigue`,
    in N*m or in the unit in brackets after it, as `vstatics simulate -o` writes it; - is
    standard input. Cycles are counted by rainflow (ASTM E1049-85, 5.4.4), and their damages
    are added (Miner's rule).

    \b
    Examples:
      vstatics new moskvich-start.yaml --template moskvich-start
      echo 'fatigue: {half-shafts: {endurance: 150 MPa, exponent: 6,
        cycles: 1e6, diameter: 30 mm}}' >> moskvich-start.yaml
      vstatics new scenarios/start.yaml --template scenarios/moskvich-start
      vstatics simulate scenarios/start.yaml -o record.csv
      vstatics damage moskvich-start.yaml record.csv
      vstatics damage moskvich-start.yaml record.csv -f json | jq .damage

    Exit status 1: the case or the record has an error.
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
