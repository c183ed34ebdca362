"""Results as listing, JSON and CSV: their shape, their numbers, what they say of themselves."""

from __future__ import annotations

import csv
import io
import json
import re
from typing import Any

import numpy as np
import pytest

from tests.commands import MZKT
from vstatics import Gear, Mechanism, Results, ShiftElement, Transmission, load, solve
from vstatics.readers import read
from vstatics.writers import listing, result_csv, result_json

SOURCE_ORDER = ["AJK", "W", "WSAT", "WFRI", "AMLG", "AMLG", "AMLGP", "AMLGP", "ETA", "IX"]
JSON_KEYS = [
    *("format", "version", "conventions", "case", "gears"),
    *("AJK", "W", "WSAT", "WFRI", "AMLG", "AMLGP", "ETA", "IX"),
    *("ratio", "idle", "losses", "power_balance", "consistent", "locked"),
]

NAMED = Transmission(
    links=4,
    link_names=["engine", "ring gear", "output", "motor"],
    shift_elements=[ShiftElement(2, 0, "Bremse"), ShiftElement(1, 2, "clutch, direct")],
    mechanisms=[
        Mechanism(1, 2, 3, -2.5, 0.96, name="planetary set"),
        Mechanism(4, 2, 0, -3.0, 0.98, name="motor pair"),
    ],
    gears=[
        Gear([1], name="low"),
        Gear(speeds={4: 0.75}, torques={2: -0.125}, name="split"),
        Gear([2], input=3, output=1, name="tow"),
        Gear(name="N"),
    ],
    output=3,
    name="named train",
)
"""A differential whose ring is braked, clutched, or turned by a motor."""


def reducer(ratio: float) -> Results:
    """A gear pair, and nothing else."""
    return solve(Transmission(2, [], [Mechanism(1, 2, 0, ratio)], [Gear()]))


@pytest.fixture(scope="module")
def published() -> Results:
    return solve(load(MZKT))


@pytest.fixture(scope="module")
def several() -> Results:
    return solve(NAMED)


def parsed(results: Results) -> dict[str, Any]:
    """A result written as JSON and read again; NaN and the like are refused."""

    def refuse(word: str) -> None:
        raise ValueError(word)

    text = result_json.write([result_json.document(results)], several=False)
    found: dict[str, Any] = json.loads(text, parse_constant=refuse)
    return found


def table(text: str, index_list: str) -> list[str]:
    """The lines of a printed table."""
    rest = text.split(index_list + "\n")[1]
    return rest.split("\n\n")[0].splitlines()


# listing


def test_tables_stand_in_the_order_of_the_source(published: Results) -> None:
    text = listing.write(published)
    heads = re.findall(r"^\(?([A-Z]+)\([IJ][,)].*:$", text.partition("RESULTS")[2], re.MULTILINE)
    assert heads[: len(SOURCE_ORDER)] == SOURCE_ORDER
    for index_list in (
        "(AJK(I,K),K=1,KLG),I=1,KJG:",
        "(W(I,J),J=1,NP),I=1,KJG:",
        "(WSAT(I,J),J=1,NP),I=1,KG:",
        "(WFRI(I,J),J=1,NP),I=1,KL:",
        "(AMLG(I,J),J=1,NP),I=1,KL:",
        "(AMLG(I,J),J=1,NP),I=(KL+1),KLG1:",
        "(AMLGP(I,J),J=1,NP),I=1,KL:",
        "(AMLGP(I,J),J=1,NP),I=(KL+1),KLG1:",
        "ETA(J),J=1,NP:",
        "(IX(I,J),J=1,NP),I=1,KG:",
    ):
        assert f"\n{index_list}\n" in text


def test_what_does_not_exist_is_asterisks_of_the_width(several: Results) -> None:
    """Nothing is engaged in the last gear: only the input's speed, 1, is known."""
    text = listing.write(several)
    column = [line.split()[-1] for line in table(text, "(W(I,J),J=1,NP),I=1,KJG:")]
    assert column == ["1.000", "*******", "*******", "*******"]
    assert table(text, "(IX(I,J),J=1,NP),I=1,KG:")[0].split()[-1] == "***"


@pytest.mark.parametrize("ratio", [3.5, -1e6, 12345678.9])
def test_columns_stay_aligned_when_numbers_are_wide(ratio: float) -> None:
    results = reducer(ratio)
    for line in listing.write(results).splitlines():
        assert "-.000" not in line
    case = Transmission(
        2, [], [Mechanism(1, 2, 0, ratio)], [Gear(), Gear(torques={1: -0.5}), Gear(input=2, output=1)]
    )  # fmt: skip
    text = listing.write(solve(case))
    for part in re.findall(r":\n((?:[ \d.*-]+\n)+)", text.partition("RESULTS")[2]):
        lines = part.splitlines()
        assert len({len(line) for line in lines}) == 1
        ends = [[found.end() for found in re.finditer(r"\S+", line)] for line in lines]
        assert all(one == ends[0] for one in ends)
    assert f"{ratio:.3f}" in text


def test_a_small_negative_number_is_printed_without_its_sign() -> None:
    """A pair of ratio -1e5 turns its second link at -.00001."""
    text = listing.write(reducer(-1e5))
    assert table(text, "(W(I,J),J=1,NP),I=1,KJG:") == ["  1.000", "   .000"]
    assert "-.000" not in text
    assert "-0" not in text


def test_headings_are_english_or_russian_and_the_numbers_the_same(several: Results) -> None:
    english, russian = listing.write(several), listing.write(several, "ru")
    assert not re.search("[а-яА-Я]", english)
    assert "КПД на передачах:\nETA(J),J=1,NP:" in russian
    assert "Efficiency" not in russian
    numbers = [re.findall(r"(?m)^[ \d.*-]+$", text) for text in (english, russian)]
    assert numbers[0] == numbers[1]


def test_messages_stand_at_the_end(several: Results, published: Results) -> None:
    text = listing.write(several)
    told = text.partition("\nMessages:\n")[2].splitlines()
    assert told == [str(message) for message in several.messages]
    assert any(line.startswith("warning: gear N: ") for line in told)
    assert "Messages" not in listing.write(published)
    assert "\nСообщения:\n" in listing.write(several, "ru")


@pytest.mark.parametrize("lang", ["en", "ru"])
def test_a_report_is_a_deck_that_gives_the_same_report(lang: Any, several: Results) -> None:
    text = listing.write(several, lang)
    reading = read(text.encode(), "report.lst")
    assert reading.case == NAMED
    assert listing.write(solve(reading.case), lang) == text


def test_every_format_states_its_conventions(several: Results) -> None:
    text = listing.write(several)
    assert "ratio is w_input/w_output" in text
    assert "output torque, given to the load" in text
    conventions = parsed(several)["conventions"]
    assert conventions["ratio"] == "w_input/w_output"
    assert "given to the load" in conventions["torques"]
    told = [row[1] for row in csv_of([several], several=False) if row[0] == "conventions"]
    assert told[0] == "ratio = w_input/w_output"
    assert "given to the load" in told[1]


# JSON


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


# CSV


def csv_of(results: list[Results], *, several: bool) -> list[list[str]]:
    named = [(f"{number}.dat", one) for number, one in enumerate(results, 1)]
    return list(csv.reader(io.StringIO(result_csv.write(named, several=several))))


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
