"""Recorded columns in CSV: where a fault stands, also behind blank lines and breaks in cells."""

from __future__ import annotations

import pytest

from vstatics.core.errors import ReadError
from vstatics.core.readers.records import read_record

WANTED = {"time": None, "torque": None}


def test_blank_lines_before_the_headings_are_passed_over() -> None:
    made = read_record(b"\n\ntime,torque\n0,1\n\n1,2\n", "r.csv", WANTED)
    assert made.columns["torque"].tolist() == [1.0, 2.0]
    assert list(made.lines) == [4, 6]


def test_a_wrong_number_is_located_behind_blank_lines_and_breaks_within_cells() -> None:
    text = b'\n"time","what\never","torque"\n0,0,1\n1,0,much\n'
    with pytest.raises(ReadError) as told:
        read_record(text, "r.csv", WANTED)
    [problem] = told.value.problems
    assert problem.id == "E121"
    assert "much" in problem.message
    assert problem.place is not None
    assert problem.place.line == 5


def test_a_cell_of_a_million_letters_is_a_located_fault() -> None:
    with pytest.raises(ReadError) as told:
        read_record(b"time,torque\n0," + b"1" * 1_000_000 + b"\n", "r.csv", WANTED)
    assert [problem.id for problem in told.value.problems] == ["E121"]


def test_a_column_that_is_missing_is_told_with_those_of_its_kind() -> None:
    links = ",".join(f"speeds[{n}]" for n in range(12))
    text = f"time,{links},torques[prop],torques[tyres]\n" + "0" + ",1" * 14 + "\n"
    record = read_record(text.encode(), "r.csv", {"time": None})
    told = record.lacks("E883", "torques[propshaft]").message
    assert "did you mean `torques[prop]`?" in told
    assert told.endswith("columns of torques are torques[prop], torques[tyres]")
    assert record.lacks("E883", "turns").message.count("speeds[") == 7
