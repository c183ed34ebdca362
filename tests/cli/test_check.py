"""`vstatics check`: everything that is wrong, with its place."""

from __future__ import annotations

import pytest

from tests.commands import BAD, MZKT, NEUTRAL, vstatics


@pytest.mark.usefixtures("files")
def test_check_speaks_like_a_compiler() -> None:
    said = vstatics("check", "bad.yaml")
    place, _, rest = said.err.partition(": error: ")
    message, line, caret = rest.splitlines()[:3]
    assert place == f"bad.yaml:3:{BAD.splitlines()[2].index('ratoi') + 1}"
    assert message.endswith("did you mean `ratio`?")
    assert line == "  " + BAD.splitlines()[2]
    assert caret.index("^") == line.index("ratoi")


def test_check_shows_the_part_of_a_long_line_around_the_place() -> None:
    deck = MZKT.read_text(encoding="utf-8").replace("1 1 4\n", "1 1" + " " * 500 + "9\n", 1)
    said = vstatics("check", "-", stdin=deck.encode())
    place, line, caret = said.err.splitlines()
    assert place.startswith("<stdin>:10:")
    assert line[caret.index("^")] == "9"
    assert len(line) <= 80


@pytest.mark.usefixtures("files")
def test_check_counts_conditions_and_prints_no_tables() -> None:
    """Two links turn freely in a differential of three: two degrees of freedom."""
    assert vstatics("check", "neutral.yaml", "tied.yaml").out.splitlines() == [
        "neutral.yaml: 3 links, 2 shift elements, 1 mechanism, 2 gears; degrees of freedom: 2",
        "  gear N    1 of 2 conditions: 1 missing (engaged: nothing)",
        "  gear low  2 of 2 conditions: ok (engaged: B)",
        "tied.yaml: 3 links, 2 shift elements, 1 mechanism, 2 gears; degrees of freedom: 2",
        "  gear both  3 of 2 conditions: 1 in excess, tied up (engaged: C B)",
        "  gear low   2 of 2 conditions: ok (engaged: B)",
    ]


def test_check_reports_all_that_is_wrong_in_one_run() -> None:
    text = NEUTRAL.replace("C: [1, 2]", "C: [2, 2]").replace("first: 1", "first: 9")
    text = text.replace("[B]", "[X]")
    lines = text.splitlines()
    columns = [lines[n].index(what) + 1 for n, what in ((1, "2]"), (2, "9"), (3, "X"))]
    said = vstatics("check", "-", stdin=text.encode()).err.splitlines()
    assert [line.partition(": ")[0] for line in said[::3]] == [
        f"<stdin>:{number}:{column}" for number, column in enumerate(columns, 2)
    ]
