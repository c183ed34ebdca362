"""`--digits N`, and the digits that numbers have without it."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.commands import CASES, MZKT, vstatics

STEP_UP = """\
links: [in, out]
mechanisms: {pair: {first: in, second: out, ratio: "-1/96.354", efficiency: 0.98}}
gears: {"1": {}}
"""
"""Ratio -1/96.354 = -0.010378396..., to be divided by hand."""


@pytest.fixture(autouse=True)
def _case(folder: Path) -> None:
    """The current one, with a step-up."""
    (folder / "up.yaml").write_text(STEP_UP, encoding="utf-8")


def test_a_small_number_has_four_significant_digits() -> None:
    assert re.search(r"^1 +-0\.01038 ", vstatics("summary", "up.yaml").out, re.MULTILINE)
    assert " -0.01038 " in vstatics("run", "up.yaml", "--pretty").out
    assert vstatics("report", "up.yaml", "-o", "up.html").status == 0
    assert ">−0.01038<" in Path("up.html").read_text(encoding="utf-8")


def test_a_listing_keeps_the_published_format() -> None:
    """F7.3."""
    assert "\nRATIO(J),J=1,NP:\n  -.010\n" in vstatics("run", "up.yaml").out


@pytest.mark.parametrize(
    ("command", "number"),
    [
        (("run",), "\nRATIO(J),J=1,NP:\n  -.010378\n"),
        (("run", "--pretty"), " -0.010378 "),
        (("summary",), "-0.010378"),
        (("flow",), "-96.354000"),
        (("explain",), "-0.010378"),
        (("run", "-f", "markdown"), "| -0.010378 |"),
        (("run", "-f", "latex"), "& $-0.010378$ &"),
        (("summary", "-f", "markdown"), "| -0.010378 |"),
        (("flow", "-f", "latex"), "0.020000"),
        (("explain", "-f", "markdown"), "| -0.010378 |"),
    ],
)
def test_every_text_has_the_digits_that_are_asked_for(
    command: tuple[str, ...], number: str
) -> None:
    said = vstatics(*command, "up.yaml", "--digits", "6")
    assert said.status == 0
    assert number in said.out


def test_the_page_has_the_digits_that_are_asked_for() -> None:
    assert vstatics("report", "up.yaml", "-o", "up.html", "--digits", "6").status == 0
    page = Path("up.html").read_text(encoding="utf-8")
    assert ">−0.010378<" in page
    assert ">−0.01038<" not in page


@pytest.mark.parametrize("digits", [1, 3, 9, 15])
def test_a_listing_of_any_digits_is_read_and_compared(digits: int) -> None:
    """Its columns grow; a number matches within half of its last digit."""
    vstatics("run", MZKT, "-f", "json", "-o", "exact.json")
    said = vstatics("run", MZKT, "--digits", digits, "-o", "printed.lst")
    assert said.status == 0
    assert vstatics("compare", "printed.lst", "exact.json").all == ""
    again = vstatics("run", "printed.lst", "--digits", digits)
    assert again.out == Path("printed.lst").read_text(encoding="utf-8")


def test_whole_numbers_and_marks_have_no_digits() -> None:
    said = vstatics("run", MZKT, "-f", "markdown", "--digits", "5").out
    signs = said.split("[power\\_sign\\]**")[1].split("**")[0]
    assert re.findall(r"\.\d", signs) == []


def test_three_digits_are_those_of_a_listing() -> None:
    assert vstatics("run", MZKT, "--digits", "3").out == vstatics("run", MZKT).out


def test_results_tell_their_file_and_compare_skips_it() -> None:
    Path("other.yaml").write_text(STEP_UP, encoding="utf-8")
    for name in ("up", "other"):
        vstatics("run", f"{name}.yaml", "-f", "json", "-o", f"{name}.json")
    one, other = (Path(f"{name}.json").read_text(encoding="utf-8") for name in ("up", "other"))
    assert '"file": "up.yaml"' in one
    assert one.replace("up.yaml", "other.yaml") == other
    assert vstatics("compare", "up.json", "other.json").all == ""
    Path("today.json").write_text(one.replace('  "file": "up.yaml",\n', ""), encoding="utf-8")
    assert vstatics("compare", "today.json", "up.json").all == ""
    assert (
        vstatics("run", "today.json", "-f", "csv").out
        == vstatics("run", "up.yaml", "-f", "csv").out
    )
    said = vstatics("run", "-", "-f", "jsonl", stdin=(CASES / "simpson.yaml").read_bytes())
    assert '"file": "<stdin>"' in said.out
