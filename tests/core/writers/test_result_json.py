"""Results as JSON: their keys, their numbers, what they say of themselves."""

from __future__ import annotations

import numpy as np
import pytest

from tests.core.writers.result_cases import csv_of, parsed
from vstatics import Results
from vstatics.core.writers import listing

JSON_KEYS = [
    *("format", "version", "conventions", "case", "gears"),
    *("AJK", "W", "WSAT", "WFRI", "AMLG", "AMLGP", "ETA", "IX"),
    *("ratio", "idle", "losses", "power_balance", "consistent", "locked"),
]


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
    assert list(parsed(published)) == [*JSON_KEYS, "messages"]
    assert list(parsed(several)) == [*JSON_KEYS, "AMWZ", "AMWZP", "messages"]
    for document in (parsed(published), parsed(several)):
        assert (document["format"], document["version"]) == ("vstatics-result", 1)


def test_json_holds_full_precision_in_the_printed_order(several: Results) -> None:
    document = parsed(several)
    arrays = {"W": several.speeds, "AMLG": several.torques, "losses": several.losses}
    for name, array in arrays.items():
        rows = np.array(document[name], dtype=float)
        np.testing.assert_array_equal(rows, array.T)
    assert document["gears"] == ["low", "split", "tow", "N"]
    assert document["case"]["links"] == ["engine", "ring gear", "output", "motor"]
    assert [len(document[name]) for name in ("AJK", "AMLG", "IX")] == [4, 5, 2]
    assert [len(row) for row in document["AJK"]] == [4] * 4


def test_json_has_null_for_what_does_not_exist(several: Results) -> None:
    document = parsed(several)
    assert document["ratio"][0] == pytest.approx(3.5)  # 1 - u with the ring held
    assert [document[name][3] for name in ("ratio", "ETA", "consistent", "locked")] == [None] * 4
    assert [row[3] for row in document["W"]] == [1.0, None, None, None]
    assert document["AMWZ"][3][0] is None
    assert document["AMWZ"][3][1] is not None
    assert {type(value) for row in document["idle"] for value in row} <= {bool, type(None)}
    assert {type(value) for row in document["IX"] for value in row} <= {int, type(None)}
