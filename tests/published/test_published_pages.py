"""The figures of the pages in docs/sources: each that no example there shows."""

from pathlib import Path

import pytest

from tests.published.pages import rows
from tests.published.test_published_umdm import TABLE_1
from tests.published.umdm_cases import GOLDEN, ratio
from tests.shipped import PRINTED

HERE = Path(__file__).parent


def test_cells_of_the_listing_that_are_wrong_in_print() -> None:
    """All that the published numbers know, with what is printed and what is right."""
    known = {
        f"{one['table']}({one['row']},{gear})": (one["printed"], one["here"])
        for one in PRINTED["corrections"]
        for gear in one["gears"]
    }
    idle = PRINTED["idle"]
    right = PRINTED[idle["table"]][idle["row"] - 1][idle["gears"][0] - 1]
    known[f"{idle['table']}({idle['row']},{idle['gears'][0]})"] = idle["printed"], right
    told = {
        row["cell"]: (float(row["printed"]), float(row["here"]))
        for row in rows("visual-statics", "Cells of the listing")
    }
    assert told == known


def test_table_1_of_the_umdm() -> None:
    """The page has the printed signs, and ratios of the program that agree with them."""
    found = {}
    for row in rows("umdm", "Table 1"):
        signs = dict(zip("145678", row["printed"].split(), strict=True))
        own = {brake: sign.replace("±", "+-") for brake, sign in signs.items() if sign != "."}
        ratios = dict(zip(own, row["ratios here"].split(), strict=True))
        assert own == TABLE_1[row["ports"]]
        found[row["ports"]] = {brake: float(value) for brake, value in ratios.items()}
        assert all(
            ("-" if value < 0 else "+") in own[one] for one, value in found[row["ports"]].items()
        )
    assert found.keys() == TABLE_1.keys()
    for ports, values in found.items():
        first, last = ports.split("-")
        expected = {q: float(ratio(GOLDEN, first, last, q)) for q in values}
        assert values == pytest.approx(expected, rel=0, abs=0.5e-4 + 1e-12)
