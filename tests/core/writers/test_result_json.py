"""Results as JSON: their keys, their numbers, what they say of themselves."""

from __future__ import annotations

import numpy as np
import pytest

from tests.core.writers.result_cases import csv_of, parsed
from vstatics import Results
from vstatics.core.writers import listing

JSON_KEYS = [
    *("format", "version", "program", "conventions", "case", "gears"),
    *(
        "distribution_matrix",
        "speeds",
        "planet_speeds",
        "slip_speeds",
        "torques",
        "lossy_torques",
        "efficiency",
        "power_sign",
    ),
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
    assert list(parsed(several)) == [
        *JSON_KEYS,
        "holding_torques",
        "lossy_holding_torques",
        "messages",
    ]
    for document in (parsed(published), parsed(several)):
        assert (document["format"], document["version"]) == ("vstatics-result", 2)


def test_json_holds_full_precision_in_the_printed_order(several: Results) -> None:
    document = parsed(several)
    arrays = {"speeds": several.speeds, "torques": several.torques, "losses": several.losses}
    for name, array in arrays.items():
        rows = np.array(document[name], dtype=float)
        np.testing.assert_array_equal(rows, array.T)
    assert document["gears"] == ["low", "split", "tow", "N"]
    assert document["case"]["links"] == ["engine", "ring gear", "output", "motor"]
    assert [len(document[name]) for name in ("distribution_matrix", "torques", "power_sign")] == [
        4,
        5,
        2,
    ]
    assert [len(row) for row in document["distribution_matrix"]] == [4] * 4


def test_json_has_null_for_what_does_not_exist(several: Results) -> None:
    document = parsed(several)
    assert document["ratio"][0] == pytest.approx(3.5)  # 1 - u with the ring held
    assert [document[name][3] for name in ("ratio", "efficiency", "consistent", "locked")] == [
        None
    ] * 4
    assert [row[3] for row in document["speeds"]] == [1.0, None, None, None]
    assert document["holding_torques"][3][0] is None
    assert document["holding_torques"][3][1] is not None
    assert {type(value) for row in document["idle"] for value in row} <= {bool, type(None)}
    assert {type(value) for row in document["power_sign"] for value in row} <= {int, type(None)}
