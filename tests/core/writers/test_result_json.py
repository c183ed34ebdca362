"""Results as JSON and as CSV: their keys, their numbers, what they say of themselves."""

import csv
import io

import numpy as np
import pytest

from tests.core.writers.result_cases import csv_of, parsed
from vstatics import Results
from vstatics.core.readers.result_rows import ABOUT
from vstatics.core.writers import listing, result_csv

JSON_KEYS = (
    "format version program conventions case gears distribution_matrix speeds planet_speeds "
    "slip_speeds torques lossy_torques efficiency power_sign ratio idle losses power_balance "
    "consistent locked"
)


def test_every_format_states_its_conventions(several: Results) -> None:
    text = listing.write(several)
    assert "ratio is w_input/w_output" in text
    assert "output torque, given to the load" in text
    conventions = parsed(several)["conventions"]
    assert conventions["ratio"] == "w_input/w_output"
    assert "given to the load" in conventions["torques"]
    told = [row[1] for row in csv_of(several) if row[0] == "conventions"]
    assert told[0] == "ratio = w_input/w_output"
    assert "given to the load" in told[1]


def test_json_has_the_keys_of_the_format(published: Results, several: Results) -> None:
    holding = "holding_torques lossy_holding_torques"
    assert " ".join(parsed(published)) == f"{JSON_KEYS} messages"
    assert " ".join(parsed(several)) == f"{JSON_KEYS} {holding} messages"
    for document in (parsed(published), parsed(several)):
        assert (document["format"], document["version"]) == ("vstatics-result", 2)


def test_json_holds_full_precision_in_the_printed_order(several: Results) -> None:
    document = parsed(several)
    for name in ("speeds", "torques", "losses"):
        rows = np.array(document[name], dtype=float)
        np.testing.assert_array_equal(rows, getattr(several, name).T)
    assert document["gears"] == ["low", "split", "tow", "N"]
    assert document["case"]["links"] == ["engine", "ring gear", "output", "motor"]
    sizes = {"distribution_matrix": 4, "torques": 5, "power_sign": 2}
    assert {name: len(document[name]) for name in sizes} == sizes
    assert [len(row) for row in document["distribution_matrix"]] == [4] * 4


def test_json_has_null_for_what_does_not_exist(several: Results) -> None:
    document = parsed(several)
    assert document["ratio"][0] == pytest.approx(3.5)  # 1 - u with the ring held
    for name in ("ratio", "efficiency", "consistent", "locked"):
        assert document[name][3] is None
    assert [row[3] for row in document["speeds"]] == [1.0, None, None, None]
    assert document["holding_torques"][3][0] is None
    assert document["holding_torques"][3][1] is not None
    assert {type(value) for row in document["idle"] for value in row} <= {bool, type(None)}
    assert {type(value) for row in document["power_sign"] for value in row} <= {int, type(None)}


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
