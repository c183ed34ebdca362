"""`--digits N`, and the digits that numbers have without it."""

import re
from pathlib import Path

import pytest

from tests.commands import MZKT, vstatics

STEP_UP = """\
links: [in, out]
mechanisms: {pair: {first: in, second: out, ratio: "-1/96.354", efficiency: 0.98}}
gears: {"1": {}}
"""
"""Ratio -1/96.354 = -0.010378396..., to be divided by hand."""
SHOWN = {
    "run": "\nRATIO(J),J=1,NP:\n  -.010\n",  # F7.3, as published
    "run --pretty": " -0.01038 ",
    "summary": "\n1              -0.01038 ",
    "run --digits 6": "\nRATIO(J),J=1,NP:\n  -.010378\n",
    "run --pretty --digits 6": " -0.010378 ",
    "summary --digits 6": "-0.010378",
    "flow --digits 6": "-96.354000",
    "explain --digits 6": "-0.010378",
    "run -f markdown --digits 6": "| -0.010378 |",
    "run -f latex --digits 6": "& $-0.010378$ &",
    "summary -f markdown --digits 6": "| -0.010378 |",
    "flow -f latex --digits 6": "0.020000",
    "explain -f markdown --digits 6": "| -0.010378 |",
}


@pytest.fixture(autouse=True)
def _case(folder: Path) -> None:
    (folder / "up.yaml").write_text(STEP_UP, "utf-8")


@pytest.mark.parametrize("line", SHOWN)
def test_a_text_has_four_significant_digits_or_those_that_are_asked_for(line: str) -> None:
    said = vstatics(*line.split(), "up.yaml")
    assert said.status == 0
    assert re.sub(" +", " ", SHOWN[line]) in re.sub(" +", " ", said.out)


def test_a_page_has_four_significant_digits_or_the_requested_number() -> None:
    for number, other, more in (("378", "38", ["--digits", "6"]), ("38", "378", [])):
        assert vstatics("report", "up.yaml", "-o", "up.html", *more).status == 0
        page = Path("up.html").read_text("utf-8")
        assert (f">−0.010{number}<" in page, f">−0.010{other}<" in page) == (True, False)


@pytest.mark.parametrize("digits", [1, 3, 9, 15])
def test_a_listing_of_any_digits_is_read_and_compared(digits: int) -> None:
    """Its columns grow; a number matches within half of its last digit; 3 are the usual ones."""
    vstatics("run", MZKT, "-f", "json", "-o", "exact.json")
    said = vstatics("run", MZKT, "--digits", digits)
    Path("printed.lst").write_text(said.out, "utf-8")
    assert vstatics("compare", "printed.lst", "exact.json").all == ""
    assert vstatics("run", "printed.lst", "--digits", digits).out == said.out
    assert (said.out == vstatics("run", MZKT).out) == (digits == 3)


def test_whole_numbers_and_marks_have_no_digits() -> None:
    said = vstatics("run", MZKT, "-f", "markdown", "--digits", "5").out
    signs = said.split("[power\\_sign\\]**")[1].split("**")[0]
    assert re.findall(r"\.\d", signs) == []
