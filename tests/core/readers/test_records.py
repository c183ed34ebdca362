"""Recorded columns in CSV and results that are read back: where a fault is."""

import pytest

from vstatics.core.errors import Problem, ReadError
from vstatics.core.model.shape import Measure
from vstatics.core.readers.records import read_record
from vstatics.core.readers.results import read_results

WANTED = {"time": None, "torque": None}


def fault_of_record(text: bytes) -> Problem:
    with pytest.raises(ReadError) as told:
        read_record(text, "r.csv", WANTED)
    [problem] = told.value.problems
    return problem


def test_units_can_be_in_a_line_below_the_headings() -> None:
    """A first row of undefined numbers is not a row of units.

    Sources: lines of units in BurntSushi/xsv/issues/245, and in ratal/mdfreader/issues/199, where
    only the time has a unit; blanks between cells in JuliaData/CSV.jl/issues/371.
    """
    wanted: dict[str, Measure | None] = {"time": None, "torque": "si_torque"}
    for units, size in (
        *(("s,kN*m", 1e3), ("[s],[kN*m]", 1e3), ("1/h,kN*m", 1e3)),
        *(("(s) , N*m", 1.0), ("s,", 1.0), (",N*m", 1.0)),
    ):
        record = read_record(f"time,torque\n{units}\n0,1\n1,-2\n".encode(), "r.csv", wanted)
        assert record.columns["torque"].tolist() == [size, -2 * size], units
        assert list(record.lines) == [3, 4]
    for first, said in (
        *(("nan,nan", "read 'nan', expected a finite"), ("0,", "read '', expected a finite")),
        ("1 2", "read '', expected a finite number; the row has 1 of 2 cells"),
        ("s,bolts", "read the unit 'bolts', expected a torque with its unit, such as `N"),
    ):
        with pytest.raises(ReadError, match=rf"r\.csv:2:1: error: .*: {said}"):
            read_record(f"time,torque\n{first}\n1,1".encode(), "r.csv", wanted)


def test_comments_clock_times_and_capitals_are_read_as_in_other_files() -> None:
    """Sources: comments in ibpsa/project1-boptest/issues/155, times in wireservice/csvkit#876."""
    wanted: dict[str, Measure | None] = {"time": "time", "torque": None}
    for text in (
        "time,torque\n0,1\n# pause, 5 min\n% 9,9\n1.5,2\n",
        "Time (s),Torque\n0,1\n1.5,2\n",
        "TIME;torque\n23:59:59,5;1\n24:00:01;2\n",
        "time,torque\n2017-07-31T23:59:59.5,1\n2017-08-01T00:00:01,2\n",
        "time,torque\n31.07.2017 23:59:59.5,1\n01.08.2017 00:00:01,2\n",
    ):
        record = read_record(text.encode(), "r.csv", wanted)
        first, last = record.columns["time"]
        assert (last - first, record.columns["torque"].tolist()) == (1.5, [1.0, 2.0]), text
    for head in ("time [ms],torque", "time,torque [kN*m]"):
        with pytest.raises(ReadError, match=r"below the unit '.*', expected one unit"):
            read_record(f"{head}\ns,N*m\n0,1".encode(), "r.csv", wanted)
    links = read_record(b"time,speeds[A],speeds[a]\n0,5,7", "r.csv", {"speeds[a]": None})
    assert links.columns["speeds[a]"].tolist() == [7]
    named = read_record(b"id,a,A\n#1,5,7\n#2,6,8\n", "r.csv", {"a": None, "A": None})
    assert [column.tolist() for column in named.columns.values()] == [[5.0, 6.0], [7.0, 8.0]]


def test_a_wrong_number_is_located_behind_blank_lines_and_breaks_within_cells() -> None:
    problem = fault_of_record(b'\n"time","what\never","torque"\n0,0,1\n\n1,0,much\n')
    assert (problem.id, "much" in problem.message) == ("E121", True)
    assert problem.place is not None
    assert problem.place.line == 6
    assert fault_of_record(b"time,torque\n0," + b"1" * 1_000_000 + b"\n").id == "E121"


def test_a_column_that_is_missing_is_reported_with_those_of_its_kind() -> None:
    links = ",".join(f"speeds[{n}]" for n in range(12))
    text = f"time,{links},torques[prop],torques[tyres]\n" + "0" + ",1" * 14 + "\n"
    record = read_record(text.encode(), "r.csv", {"time": None})
    told = record.lacks("E883", "torques[propshaft]").message
    assert "did you mean `torques[prop]`?" in told
    assert told.endswith("columns of torques are torques[prop], torques[tyres]")
    assert record.lacks("E883", "turns").message.count("speeds[") == 7
    titled = read_record(b"Test 7\n\n" + text.encode(), "r.csv", {"time": None})
    assert str(titled.lacks("E883", "turns").place) == "r.csv:3:1"
    blanks = read_record(b"time torques[a]\n0 1\n", "r.csv", {"time": None})
    assert "; separate the cells by" in blanks.lacks("E883", "torques[a]").message


GOOD = '{"ratio": [1.5]}'


def test_a_fault_of_a_result_has_its_line() -> None:
    for text, line, column, words in (
        (f"{GOOD}\n\n \n{GOOD[:-1]}\n{GOOD}\n", 4, 16, "the file is not JSON: "),
        (f"\n\n{GOOD}\n{GOOD}\n{{]\n", 5, 2, "the file is not JSON: "),
        (f"{GOOD[:-1]}\n{GOOD}\n", 1, 16, "the file is not JSON: "),
        (f"{GOOD}\nx\n", 2, 1, "the file is not JSON: "),
        (f"{GOOD}\n\n7\n", 3, 1, "result 2 is not a JSON object"),
        (f"{GOOD}\r\n\r\n{{}}\r\n", 3, 1, "result 2 has none of the tables"),
        (f'{GOOD}\n\n{{"ratio": 1}}\n', 3, 1, "ratio of result 2 is not a table of numbers"),
        ('{\n  "ratio": [1,]\n}\n', 2, 15, "the file is not JSON: "),
        ('{\n  "ratio": [1]\n}\nx\n', 4, 1, "the file is not JSON: "),
        # a carriage return alone ends a line of CSV; a cell has 131072 characters at most
        ("table,row,gear,value\nW,D\r,2,1\n", 2, None, "no row of a result"),
        (f"table,row,gear,value\nW,1,1,{'1' * 140_000}\n", 2, None, "the file is not CSV: field l"),
    ):
        with pytest.raises(ReadError) as caught:
            read_results(text.encode(), "file")
        (problem,) = caught.value.problems
        assert problem.place is not None
        assert (problem.place.line, column or problem.place.column) == (line, problem.place.column)
        assert problem.message.startswith(words)
