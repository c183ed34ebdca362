"""Names of rows: a table has the same ones in every place, of cases that are drawn above all."""

import numpy as np
import pytest

from tests.core.elements.element_texts import AOD, loaded
from tests.core.writers.result_cases import csv_of, table
from vstatics import Results, solve
from vstatics.core.tables.names import table_rows
from vstatics.core.writers import listing
from vstatics.core.writers.result_json import document

OWN = ["small_sun", "large_sun", "ring", "carrier"]
ELEMENTS = ["forward", "reverse", "direct", "overdrive", "low"]
ROWS = {"losses": ["set"], "torques": [*ELEMENTS, *(f"set.{member}" for member in OWN), "Mx"]}
"""What the text of the case names: one set of four members, five shift elements."""
GEARS = ["1", "2", "3", "4", "R"]


@pytest.fixture(scope="module")
def aod() -> Results:
    return solve(loaded(AOD))


@pytest.mark.parametrize("name", ROWS)
def test_rows_are_those_that_the_case_names(aod: Results, name: str) -> None:
    """In the arrays, in JSON and in CSV."""
    assert list(table_rows(name, aod.case)) == ROWS[name]
    assert getattr(aod, name).shape == (len(GEARS), len(ROWS[name]))
    in_json = document(aod)
    assert in_json["rows"][name] == ROWS[name]
    values = np.array(in_json[name]).T
    assert values == pytest.approx(getattr(aod, name))
    in_csv = [line for line in csv_of(aod) if line[0] == name]
    assert len(in_csv) == len(GEARS) * len(ROWS[name])
    assert {row for line in in_csv for row in line} >= set(ROWS[name])


def test_the_listing_has_these_rows(aod: Results) -> None:
    """Torques stand in two tables, shift elements above; the name follows a stroke."""
    text = listing.write(aod)
    torques = table(text, "(AMLG(I,J),J=1,NP),I=1,KL:")
    torques += table(text, "(AMLG(I,J),J=1,NP),I=(KL+1),KLG1:")
    losses = table(text, "(LOSS(I,J),J=1,NP),I=1,KG:")
    for name, lines in {"torques": torques, "losses": losses}.items():
        assert [line.partition("| ")[2] for line in lines] == ROWS[name]
