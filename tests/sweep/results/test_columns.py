"""The columns of --out: their headings, and what they hold."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.chance import count
from tests.commands import MZKT
from tests.shipped import PRINTED
from tests.strategies import transmissions
from tests.sweep.asked import SET, VARIED, marked, problem
from vstatics import Gear, Mechanism, ReadError, Transmission, load, solve
from vstatics.core.numerics.arrays import Floats
from vstatics.core.readers.named.nodes import MOST_PROBLEMS
from vstatics.core.statics.result_arrays import ARRAYS
from vstatics.core.tables.names import table_rows
from vstatics.sweep.results.columns import read_columns
from vstatics.sweep.variants.targets import Target, target

HALF_A_UNIT = 0.5e-3 + 1e-12


def headings(text: str, targets: list[Target] = VARIED) -> tuple[str, ...]:
    return read_columns(text, SET, targets).headings


def test_columns_have_the_names_of_rows_and_gears() -> None:
    assert headings("ratio") == ("ratio[2]", 'ratio["1R"]', "ratio[N]")
    assert headings("speeds[in]") == ("speeds[in,2]", 'speeds[in,"1R"]', "speeds[in,N]")
    assert headings("speeds[:,2]") == ("speeds[вал,2]", 'speeds["ring 1",2]', "speeds[in,2]")
    assert headings("speeds")[:4] == (
        *("speeds[вал,2]", 'speeds[вал,"1R"]', "speeds[вал,N]"),
        'speeds["ring 1",2]',
    )
    assert headings("torques[#2,#2]") == ('torques["4-5","1R"]',)


def test_expressions_are_columns_with_their_text() -> None:
    assert headings(" ratio[2]\n+ 1 ,max(ratio, 3)") == (
        "ratio[2] + 1",
        *("max(ratio, 3)[2]", 'max(ratio, 3)["1R"]', "max(ratio, 3)[N]"),
    )
    assert headings("ratio - 1")[0] == "(ratio - 1)[2]"
    assert headings("abs(losses)")[1] == 'abs(losses)[D1,"1R"]'
    assert headings("ETA[2], W[in], max(ETA) - 1, x = AMLGP[Mx,2], (efficiency)") == (
        "efficiency[2]",
        *("speeds[in,2]", 'speeds[in,"1R"]', "speeds[in,N]"),
        "max(efficiency) - 1",
        "x",
        *('efficiency["1R"]', "efficiency[N]"),
    )
    assert "expected ETA[gear]" in problem("ETA[2,1]").message


def test_what_is_asked_for_twice_or_varied_is_written_once() -> None:
    assert headings("ratio[N],ratio,ratio[#1]") == ("ratio[N]", "ratio[2]", 'ratio["1R"]')
    assert headings("max(ratio),max(ratio)") == ("max(ratio)",)
    assert headings("D1.ratio,'D1'.ratio,#1.ratio,max(ratio)") == ("max(ratio)",)
    assert headings("D1.efficiency") == ("D1.efficiency",)
    assert headings("D1.ratio", []) == ("D1.ratio",)


def test_all_problems_of_the_columns_are_reported_up_to_a_limit() -> None:
    text = "ratio, rato, speeds[in,'x,y'], max(1,efficency)"
    with pytest.raises(ReadError) as caught:
        read_columns(text, SET, VARIED)
    places = [problem.place for problem in caught.value.problems]
    begins = [text[place.column - 1 :].partition(",")[0] for place in places if place]
    assert begins == ["rato", "'x", "efficency)"]
    assert marked("ratio,", "--out") == ""
    with pytest.raises(ReadError) as caught:
        read_columns("a," * 10**6, SET, VARIED)
    assert len(caught.value.problems) == MOST_PROBLEMS


@settings(max_examples=count(8, 60))
@given(transmissions(), st.sampled_from(list(ARRAYS)))
def test_each_heading_reads_back_as_its_column_whatever_the_names(
    case: Transmission, table: str
) -> None:
    rows = table_rows(table, case)
    if ARRAYS[table].rows != "one" and not rows:
        return
    columns = read_columns(table, case, [])
    assert len(set(columns.headings)) == len(columns.headings) == len(case.gears) * (len(rows) or 1)
    cells = columns.parts[0].cells
    for heading, (gear, row) in zip(columns.headings, cells, strict=True):
        (again,) = read_columns(heading, case, []).parts
        assert again.expression.node == (table, gear, row if rows else None, len(rows))


def test_columns_of_the_published_gearbox_are_the_published_numbers() -> None:
    """Every table of the source by name, at the source's own ratios."""
    case = load(MZKT)
    results = solve(case, ratios=np.array([[m.ratio for m in case.mechanisms]]))
    for name in ("W", "WSAT", "WFRI", "AMLG", "AMLGP", "ETA", "IX"):
        made: Floats = read_columns(name, case, [])(results, np.zeros((1, 0)))[0]
        expected = np.array(PRINTED[name], dtype=np.float64).ravel()
        assert made == pytest.approx(expected, rel=0, abs=HALF_A_UNIT), name


def test_a_product_is_no_varied_number_of_the_same_letters() -> None:
    """`2*B.ratio` is twice the ratio of B, though a mechanism `2*B` is varied."""
    pairs = [Mechanism(1, 2, 0, -2.0, name="2*B"), Mechanism(2, 3, 0, -5.0, name="B")]
    case = Transmission(3, [], pairs, [Gear()])
    varied = [target("2*B.ratio", case)]
    columns = read_columns('2*B.ratio, "2*B".ratio', case, varied)
    assert columns.headings == ("(2*B.ratio)",)
    ratios = np.array([[-3.0, -5.0], [-4.0, -5.0]])
    made = columns(solve(case, ratios=ratios), ratios[:, :1])
    assert made.tolist() == [[-10.0], [-10.0]]
