"""Results as CSV: a number a row."""

from __future__ import annotations

from tests.writers.result_cases import csv_of
from vstatics import Results
from vstatics.writers import result_csv


def test_csv_has_a_number_a_row(several: Results) -> None:
    head, *body = csv_of([several], several=False)
    assert head == ["table", "row", "gear", "value"]
    assert {len(row) for row in body} == {4}
    numbers = {tuple(row[:3]): row[3] for row in body}
    assert len(numbers) == len(body)
    assert float(numbers["W", "output", "low"]) == several.speeds[0, 2]
    assert float(numbers["AMLG", "planetary set", "split"]) == several.torques[1, 2]
    assert numbers["WFRI", "clutch, direct", "tow"] == "0.0"
    assert numbers["ratio", "ratio", "N"] == ""
    assert numbers["AJK", "ring gear:Bremse", ""] == "1.0"
    assert numbers["IX", "motor pair", "N"] == ""
    assert numbers["IX", "planetary set", "low"] == "1"
    assert len([place for place in numbers if place[0] == "W"]) == 4 * 4
    assert "nan" not in result_csv.write([("a", several)], several=False).lower()


def test_csv_of_several_cases_has_a_column_for_the_case(
    several: Results, published: Results
) -> None:
    head, *body = csv_of([several, published], several=True)
    body = [row for row in body if row[1] != "conventions"]
    assert head == ["case", "table", "row", "gear", "value"]
    assert list(dict.fromkeys(row[0] for row in body)) == ["1.dat", "2.dat"]
    alone = csv_of([published], several=False)[1:]
    assert [row[1:] for row in body if row[0] == "2.dat"] == [
        row for row in alone if row[0] != "conventions"
    ]
