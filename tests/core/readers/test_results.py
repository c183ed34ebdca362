"""Results that are read back: where a fault in JSON or JSON lines is."""

from __future__ import annotations

import pytest

from vstatics.core.errors import ReadError
from vstatics.core.readers.results import read_results

GOOD = '{"ratio": [1.5]}'


def where(text: str) -> tuple[int, int, str]:
    """Line, column and words of the one fault of a text."""
    with pytest.raises(ReadError) as caught:
        read_results(text.encode(), "file")
    (problem,) = caught.value.problems
    assert problem.place is not None
    return problem.place.line, problem.place.column, problem.message


@pytest.mark.parametrize(
    ("text", "line", "column", "words"),
    [
        (f"{GOOD}\n{GOOD[:-1]}\n{GOOD}\n", 2, 16, "the file is not JSON: "),
        (f"{GOOD}\n\n \n{GOOD[:-1]}\n", 4, 16, "the file is not JSON: "),
        (f"\n\n{GOOD}\n{GOOD}\n{{]\n", 5, 2, "the file is not JSON: "),
        (f"{GOOD[:-1]}\n{GOOD}\n", 1, 16, "the file is not JSON: "),
        (f"{GOOD}\nx\n", 2, 1, "the file is not JSON: "),
        (f"{GOOD}\n\n7\n", 3, 1, "result 2 is not a JSON object"),
        (f"{GOOD}\r\n\r\n{{}}\r\n", 3, 1, "result 2 has none of the tables"),
        (f'{GOOD}\n\n{{"ratio": 1}}\n', 3, 1, "ratio of result 2 is not a table of numbers"),
        ('{\n  "ratio": [1,]\n}\n', 2, 15, "the file is not JSON: "),
        ('{\n  "ratio": [1]\n}\nx\n', 4, 1, "the file is not JSON: "),
    ],
)
def test_a_fault_has_its_line_in_the_file(text: str, line: int, column: int, words: str) -> None:
    found = where(text)
    assert (found[:2], found[2].startswith(words)) == ((line, column), True), found


def test_empty_lines_before_and_between_json_lines_are_nothing() -> None:
    read = read_results(f"\n{GOOD}\n \n{GOOD}\n\n".encode(), "file")
    assert [one.tables["ratio"][0][0].value for one in read] == [1.5, 1.5]


@pytest.mark.parametrize(
    ("cells", "line", "words"),
    [("W,D\r,2,1", 2, "no row of a result"), ("W,1,1," + "1" * 140_000, 2, "no CSV: field larger")],
)
def test_what_csv_does_not_take_is_told_with_its_line(cells: str, line: int, words: str) -> None:
    """A carriage return alone ends a line; a cell has 131072 characters at most."""
    found = where(f"table,row,gear,value\n{cells}\n")
    assert (found[0], found[2].startswith(words)) == (line, True), found
