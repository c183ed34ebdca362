"""`vstatics check`: everything that is wrong, with its place."""

from __future__ import annotations

from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

from tests.commands import BAD, MZKT, NEUTRAL, vstatics
from vstatics.core.cli.schemas import schemas


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
        "  gear N    1 of 2 constraints: 1 missing (engaged: nothing)",
        "  gear low  2 of 2 constraints: ok (engaged: B)",
        "tied.yaml: 3 links, 2 shift elements, 1 mechanism, 2 gears; degrees of freedom: 2",
        "  gear both  3 of 2 constraints: 1 in excess, tied up (engaged: C B)",
        "  gear low   2 of 2 constraints: ok (engaged: B)",
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


# for editors and CI


@pytest.mark.usefixtures("files")
def test_json_has_a_place_for_each_problem_and_stderr_has_none() -> None:
    said = vstatics("check", "bad.yaml", "neutral.yaml", MZKT, "none.yaml", "-f", "json")
    assert (said.status, said.err) == (1, "")
    found = said.json
    assert not list(Draft202012Validator(schemas()["check"]).iter_errors(found))
    assert [(Path(one["file"]).name, one["severity"]) for one in found] == [
        ("bad.yaml", "error"),
        ("neutral.yaml", "error"),
        ("neutral.yaml", "warning"),
        ("mzkt7922.dat", "note"),
        ("none.yaml", "error"),
    ]
    bad, neutral, _, _, none = found
    assert (bad["line"], bad["column"]) == (3, BAD.splitlines()[2].index("ratoi") + 1)
    assert bad["message"].endswith("did you mean `ratio`?")
    assert (neutral["line"], neutral["column"]) == (4, NEUTRAL.splitlines()[3].index("N:") + 1)
    assert (none["line"], none["column"]) == (None, None)


def test_json_of_what_is_well_is_an_empty_array() -> None:
    good = NEUTRAL.replace("N: {}, ", "").encode()
    assert vstatics("check", "-", "-f", "json", stdin=good) == (0, "[]\n", "")


def test_json_has_every_gear_of_one_text() -> None:
    text = NEUTRAL.replace("N: {}", "N: {}, P: {}").encode()
    said = vstatics("check", "-", "-f", "json", "--strict", stdin=text)
    assert said.status == 1
    assert [one["message"][:8] for one in said.json] == [
        *("gears.N:", "gears.P:"),
        *("gear N: ", "gear P: "),
    ]
    allowed = text + b"allow: [W414]\n"
    again = NEUTRAL.replace("B: [2, housing]", "B: [2, housing], A: [2, housing]").replace(
        "N: {}", "N: {engaged: [A, B]}"
    )
    quiet = vstatics("check", "-", "-f", "json", "-q", "--strict", stdin=again.encode())
    assert (quiet.status, [one["id"] for one in quiet.json]) == (1, ["E013"])
    assert vstatics("check", "-", "--strict", stdin=allowed).status == 0


@pytest.mark.usefixtures("files")
def test_check_writes_to_a_file_by_its_suffix() -> None:
    call = ["check", "neutral.yaml", "bad.yaml"]
    assert vstatics(*call, "-o", "x.json").out == ""
    assert Path("x.json").read_text("utf-8") == vstatics(*call, "-f", "json").out
    assert vstatics(*call, "-o", "x.txt").err == vstatics(*call).err
    assert Path("x.txt").read_text("utf-8") == vstatics(*call).out
    for output, *more in (("x.csv",), ("x.json", "-f", "text"), ("bad.yaml",), ("new/",)):
        assert vstatics(*call, "-o", output, *more).status == 2


def test_a_note_tells_which_gear_asks_a_law_outside_its_points(tmp_path: Path) -> None:
    """Half the 2000 rpm are 105 rad/s."""
    case = tmp_path / "case.yaml"
    case.write_text(
        "links: [in, out]\n"
        "load: {speed: 2000 rpm, torque: 50 N*m}\n"
        "mechanisms: {pair: {first: in, second: out, ratio: 2}}\n"
        "gears:\n  near: {drag: {out: [[0, 1], [110, 2]]}}\n  far: {drag: {out: [[0, 1], [100, 2]]}}\n"
    )
    said = vstatics("check", str(case)).err
    assert (
        "case.yaml:6:3: note: gear far: outside the points of out, the value of the nearest end point applies"
        in said
    )


@pytest.mark.parametrize(
    ("drag", "said"),
    [("1 - 0.1*w", "the drag of out: read -9.47198"), ("exp(w*w)", "the drag of out: read inf")],
)
def test_a_drag_that_no_torque_can_be_is_told_at_its_place(
    tmp_path: Path, drag: str, said: str
) -> None:
    """At 1000 rpm w is 104.7198 rad/s."""
    case, result = tmp_path / "case.yaml", tmp_path / "result.json"
    case.write_text(
        "links: [in, out]\n"
        "load: {speed: 1000 rpm, torque: 50 N*m}\n"
        "mechanisms: {pair: {first: in, second: out, ratio: 1}}\n"
        f"gears: {{one: {{drag: {{out: '{drag}'}}}}}}\n"
    )
    for command in (["check"], ["run", "-o", str(result)], ["flow"]):
        ran = vstatics(*command, str(case))
        assert ran.fails("case.yaml:4:22: error: gears.one.drag.out: " + said)
    assert not result.exists()
