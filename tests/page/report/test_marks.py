"""Every result on a page that changes says what it is, and a page that stays says nothing more."""

import re

import numpy as np
import pytest

from tests.chance import count, seeded
from tests.commands import CASES, json_answer
from tests.page.report.pages import Page
from tests.shipped import shipped_results
from tests.trains import random_train
from vstatics import example, solve
from vstatics.core.statics.solve import distribution_matrix
from vstatics.core.tables.quantities import QUANTITIES
from vstatics.core.tables.result_tables import of_results
from vstatics.page.report.html_page import page
from vstatics.page.report.material import gather
from vstatics.page.report.tools.marks import with_tool_marks

pytestmark = pytest.mark.usefixtures("without_pictures")


def test_each_number_of_the_json_stands_on_the_page_with_all_digits() -> None:
    document = json_answer("run", CASES / "ford-6r80.yaml")
    results = shipped_results("ford-6r80.yaml")
    shown = Page(page(gather(results, has_marks=True)))
    on_page = {
        tuple(one.attributes.get(f"data-{key}") for key in ("result", "row", "gear")): number
        for one in shown.elements
        if (number := one.attributes.get("data-number")) is not None
    }
    well = {"power_balance", "consistent", "locked"}  # a sentence says these of all gears
    for quantity in QUANTITIES:
        key = quantity.name
        if quantity.columns != "gears" or key not in document or key in well:
            continue
        rows = [None] if quantity.rows == "one" else document["rows"][key]
        table = [document[key]] if quantity.rows == "one" else document[key]
        for row, values in zip(rows, table, strict=True):
            for gear, value in zip(document["gears"], values, strict=True):
                number = on_page[key, row, gear]
                assert (float(number) if number else None) == value, (key, row, gear)


def test_a_page_that_stays_is_the_same_without_its_marks() -> None:
    results = shipped_results("simpson.yaml")
    static, live = page(gather(results)), page(gather(results, has_marks=True))
    marks = r' data-result="[^"]*"(?: data-row="[^"]*")?(?: data-gear="[^"]*")? data-number="[^"]*"'
    assert "data-number" not in static
    own = r' data-(?:unit|scaled)="[^"]*"(?: data-gear="[^"]*")?(?: data-repeats="")?'
    figure = r'<span data-gear="[^"]*" data-value="[^"]*" data-\w+="Nm">(.*?)</span> <span class="unit">(.*?)</span>'
    live = re.sub(figure, r"\1 \2", live)
    assert re.sub(rf'{marks}|{own}| data-links="[^"]*"', "", live) == static


def test_a_torque_is_of_the_links_where_the_matrix_has_its_device() -> None:
    """Rows know the links on which their component acts."""
    chance = seeded(7)
    for _ in range(count(20, 200)):
        case = random_train(chance, regular=True)
        [grid] = [one for one in of_results(solve(case)) if one.key == "torques"]
        rows = [row[0] for row in with_tool_marks(grid, case).cells]
        *devices, output = [[int(one) for one in row.marks["links"].split()] for row in rows]
        assert output == [case.main_output - 1]
        for own, column in zip(devices, distribution_matrix(case).T, strict=True):
            assert {*np.flatnonzero(column).tolist()} <= {*own}
            assert len(own) <= 3
    case = example("zf-8hp70")  # whose members have rows of their own
    [grid] = [one for one in of_results(solve(case)) if one.key == "torques"]
    marks = {row[0].text: row[0].marks["links"] for row in with_tool_marks(grid, case).cells}
    assert marks["P1.carrier"] == str(case.link_names.index("carrier 1"))
