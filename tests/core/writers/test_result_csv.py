"""Results as CSV: a number a row."""

from __future__ import annotations

import csv
import io

from tests.core.writers.result_cases import csv_of
from vstatics import Results
from vstatics.core.readers.result_rows import ABOUT
from vstatics.core.writers import result_csv


def test_csv_has_a_number_a_row(several: Results) -> None:
    head, *body = csv_of(several)
    assert head == ["table", "row", "gear", "value"]
    assert {len(row) for row in body} == {4}
    numbers = {tuple(row[:3]): row[3] for row in body}
    assert len(numbers) == len(body)
    assert float(numbers["speeds", "output", "low"]) == several.speeds[0, 2]
    assert float(numbers["torques", "planetary set", "split"]) == several.torques[1, 2]
    assert numbers["slip_speeds", "clutch, direct", "tow"] == "0.0"
    assert numbers["ratio", "ratio", "N"] == ""
    assert numbers["distribution_matrix", "ring gear:Bremse", ""] == "1.0"
    assert numbers["power_sign", "motor pair", "N"] == ""
    assert numbers["power_sign", "planetary set", "low"] == "1"
    assert len([place for place in numbers if place[0] == "speeds"]) == 4 * 4
    assert "nan" not in result_csv.write(several).lower()


def test_rows_among_several_begin_with_the_file_of_their_case(published: Results) -> None:
    rows = list(csv.reader(io.StringIO(result_csv.rows("1.dat", published))))
    alone = [row for row in csv_of(published)[1:] if row[0] not in ABOUT]
    assert rows == [["1.dat", *row] for row in alone]
    assert result_csv.head(several=True) == "case,table,row,gear,value\n"
