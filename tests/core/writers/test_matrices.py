"""The two matrices of a structure, as Evseenko prints them for the BelAZ-7516."""

import csv
import io

import pytest

from tests.commands import CASES, MZKT, vstatics
from tests.installed import needs

TABLE_1 = """\
J_1	0	0	-1	0	0	0	0	0	0	0	0	0
J_2	0	1	0	1	0	0	1	0	0	0	0	0
J_3	1	0	0	0	0	0	0	0	0	0	0	0
J_4	0	0	0	0	0	1	0	0	0	0	0	0
J_5	0	0	0	0	1	0	0	0	1	1	0	0
J_6	0	0	0	0	0	0	0	0	0	0	0	1
J_7	0	0	0	0	0	0	0	1	0	0	1	0
"""
TABLE_2 = """\
J_1	-1	0	0	0	0	0
J_2	1	-1	0	0	0	0
J_3	0	0	-1	0	0	0
J_4	0	0	0	-1	0	0
J_5	0	1	0	0	-1	0
J_6	0	0	0	0	0	-1
J_7	0	0	0	0	0	0
"""
"""Method of synthesis of planetary gearboxes with any number of degrees of freedom (in Russian),
tables 1 and 2, as printed; a, h, b are sun, carrier and ring."""
SET = """\
links: 3
shift_elements: {B: [0, 2]}
mechanisms:
  "=P": {first: 1, second: 2, third: housing, ratio: -2}
  Q: {first: 1, second: 2, third: 3, ratio: -2}
gears: {"1": {}}
"""


def matrices(*case: object, stdin: str = "") -> list[list[list[str]]]:
    """The rows of the two tables, with their headings."""
    said = vstatics("convert", *case, "-", "--to", "matrices", stdin=stdin.encode())
    assert said.is_without_messages()
    return [[*csv.reader(io.StringIO(table))] for table in said.out.split("\n\n")]


@pytest.mark.parametrize(("table", "printed"), [(0, TABLE_1), (1, TABLE_2)])
def test_they_are_the_printed_ones(table: int, printed: str) -> None:
    heading, *rows = matrices(CASES / "belaz7516.yaml")[table]
    assert rows == [line.replace("_", "").split("\t") for line in printed.splitlines()]
    sets = ",".join(f"P{n}.a,P{n}.h,P{n}.b" for n in range(1, 5))
    assert ",".join(heading) == f"link,{('F1,F2,T1,T2,T3,T4', sets)[not table]}"


def test_a_deck_has_them_by_its_mechanisms() -> None:
    """Table 4 of the paper on the MZKT 7922: which links are joined, its two devices D3 and F5."""
    rigid, variable = matrices(MZKT)
    assert [row[0] for row in rigid if row[-3] == "1"] == ["4"]
    assert {row[0]: row[-1] for row in variable[1:] if row[-1] != "0"} == {"4": "-1", "6": "1"}
    assert rigid[1][:4] == ["1", "-1", "0", "0"]


def test_the_housing_has_no_row() -> None:
    """A carrier that is held has a column of zeros; a brake may name its link second."""
    rigid, variable = matrices("-", "--from", "yaml", stdin=SET)
    assert [row[2] for row in rigid] == ["'=P.h", "0", "0", "0"]
    assert [row[1] for row in variable] == ["B", "0", "-1", "0"]


@pytest.mark.parametrize(
    "case", [pytest.param("moskvich412.yaml", marks=needs("torsion")), "umdm.yaml"]
)
def test_what_is_no_planetary_set_has_none(case: str) -> None:
    said = vstatics("convert", CASES / case, "-", "--to", "matrices")
    assert said.gives_nothing("has the members", "expected a set of sun, carrier and ring")
