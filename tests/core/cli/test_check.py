"""`vstatics check`: everything that is wrong, with its place."""

import io
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

import vstatics as library
from tests.commands import BAD, MZKT, NEUTRAL, json_answer, vstatics
from tests.core.cli.conftest import OPEN
from vstatics.core.cli.schemas import schemas

COLUMN = BAD.splitlines()[2].index("ratoi") + 1
PAIR = """\
links: [in, out]
load: {speed: 2000 rpm, torque: 50 N*m}
mechanisms: {pair: {first: in, second: out, ratio: 2}}
"""


@pytest.mark.usefixtures("files")
def test_check_speaks_like_a_compiler() -> None:
    place, _, words = vstatics("check", "bad.yaml").err.partition(": error: ")
    message, line, caret = words.splitlines()[:3]
    assert place == f"bad.yaml:3:{COLUMN}"
    assert message.endswith("did you mean `ratio`?")
    assert line == "  " + BAD.splitlines()[2]
    assert caret.index("^") == line.index("ratoi")
    deck = MZKT.read_text("utf-8").replace("1 1 4\n", "1 1" + " " * 500 + "9\n", 1)
    place, line, caret = vstatics("check", "-", stdin=deck.encode()).err.splitlines()
    assert place.startswith("<stdin>:10:")
    assert line[caret.index("^")] == "9"
    assert len(line) <= 80  # the part of a long line around the place


@pytest.mark.usefixtures("files")
def test_check_counts_conditions_and_prints_no_tables() -> None:
    """Two links turn freely in a differential of three: two degrees of freedom."""
    assert vstatics("check", "neutral.yaml", "tied.yaml").out.splitlines() == [
        "neutral.yaml: 3 links, 2 shift elements, 1 mechanism, 2 gears;",
        "    degrees of freedom: 2",
        "  gear N    1 of 2 constraints: 1 missing (engaged: nothing)",
        "  gear low  2 of 2 constraints: ok (engaged: B)",
        "tied.yaml: 3 links, 2 shift elements, 1 mechanism, 2 gears;",
        "    degrees of freedom: 2",
        "  gear both  3 of 2 constraints: 1 in excess, tied up (engaged: C B)",
        "  gear low   2 of 2 constraints: ok (engaged: B)",
    ]


@pytest.mark.usefixtures("files")
def test_json_has_a_place_for_each_problem_and_stderr_has_none() -> None:
    said = vstatics("check", "bad.yaml", "neutral.yaml", MZKT, "none.yaml", "-f", "json")
    assert (said.status, said.err) == (1, "")
    found = said.json
    assert not list(Draft202012Validator(schemas()["check"]).iter_errors(found))
    gear = NEUTRAL.splitlines()[3].index("N:") + 1
    keys = "severity", "line", "column"
    places = [(Path(one["file"]).name, *(one[key] for key in keys)) for one in found]
    assert places[:3] + places[4:] == [
        ("bad.yaml", "error", 3, COLUMN),
        ("neutral.yaml", "error", 4, gear),
        ("neutral.yaml", "warning", 4, gear),
        ("none.yaml", "error", None, None),
    ]
    assert places[3][:2] == ("mzkt7922.dat", "note")
    assert found[0]["message"].endswith("did you mean `ratio`?")
    good = NEUTRAL.replace("N: {}, ", "").encode()
    assert vstatics("check", "-", "-f", "json", stdin=good) == (0, "[]\n", "")
    # each gear of the case has its own message
    text = NEUTRAL.replace("N: {}", "N: {}, P: {}").encode()
    said = vstatics("check", "-", "-f", "json", "--strict", stdin=text)
    told = [one["message"][:8] for one in said.json]
    assert (said.status, told) == (1, ["gears.N:", "gears.P:", "gear N: ", "gear P: "])
    quiet = vstatics("check", "-", "-f", "json", "-q", "--strict", stdin=OPEN.encode())
    assert (quiet.status, [one["id"] for one in quiet.json]) == (1, ["E013"])


@pytest.mark.usefixtures("files")
def test_check_writes_to_a_file_by_its_suffix() -> None:
    call = ["check", "neutral.yaml", "bad.yaml"]
    for name, form in (("x.json", "json"), ("x.sarif", "sarif"), ("x.xml", "junit")):
        assert vstatics(*call, "-o", name).gives_nothing()
        assert Path(name).read_text("utf-8") == vstatics(*call, "-f", form).out
    assert vstatics(*call, "-o", "x.txt").err == vstatics(*call).err
    assert Path("x.txt").read_text("utf-8") == vstatics(*call).out
    for output in ("x.csv", "x.json -f text", "bad.yaml", "new/"):
        assert vstatics(*call, "-o", *output.split()).status == 2


def test_a_note_tells_which_gear_asks_a_law_outside_its_points() -> None:
    """Half the 2000 rpm are 105 rad/s, and 3000/pi rpm are 100 rad/s."""
    gears = "gears:\n"
    for name, end in (("near", 110), ("far", 100)):
        gears += f"  {name}: {{drag: {{out: [[0, 1], [{end}, 2]]}}}}\n"
    said = vstatics("check", "-", stdin=f"{PAIR}{gears}".encode()).err
    words = (
        "outside the points of out (0 to 954.93 rpm), the value of the nearest end point applies"
    )
    assert f"<stdin>:6:3: note: gear far: {words}" in said
    assert "gear near" not in said


def test_an_impossible_drag_is_reported_at_its_place(folder: Path) -> None:
    """At 1000 rpm w is 104.7198 rad/s."""
    for drag, value in (("1 - 0.1*w", "-9.47198"), ("exp(w*w)", "inf")):
        text = f"{PAIR.replace('2000', '1000')}gears: {{one: {{drag: {{in: '{drag}'}}}}}}\n"
        (folder / "case.yaml").write_text(text)
        words = f"case.yaml:4:22: error: gears.one.drag.in: the drag of in: read {value}"
        for command in ("check", "run -o result.json", "flow"):
            assert vstatics(*command.split(), "case.yaml").fails(words), (command, drag)
    assert not Path("result.json").exists()


TWO_SPEED = """name: two-speed
links: [in, ring, carrier]
shift_elements: {B: [ring, housing], C: [in, ring]}
mechanisms: {P: {first: in, second: ring, third: carrier, ratio: -2}}
input: in
output: carrier
"""
GEARS = "gears: {low: {engaged: [B]}, direct: {engaged: [C]}, N: {engaged: []%s}}\n"
OPEN_GEAR, MEANT = f"{TWO_SPEED}{GEARS % ''}", f"{TWO_SPEED}{GEARS % ', kind: neutral'}"


def test_a_gear_that_cannot_drive_fails_the_check_at_its_place() -> None:
    stdin = OPEN_GEAR.encode()
    words = f"<stdin>:7:{1 + GEARS.index('N:')}: error: gears.N: cannot drive: expected another"
    assert vstatics("check", "-", stdin=stdin).fails(words)
    ids = [problem["id"] for problem in json_answer("check", "-", stdin=stdin)]
    assert ids == [problem.id for problem in library.check(io.StringIO(OPEN_GEAR))]
    assert ids == ["E453", "W414"]
    for command in ("run", "summary", "flow"):
        assert vstatics(command, "-", stdin=stdin).status == 0


def test_messages_on_a_deck_name_its_fields_instead_of_keys() -> None:
    text = NEUTRAL.replace("-2.5", "2.5").encode()
    deck = vstatics("convert", "-", "-", "--to", "deck", stdin=text).out.encode()
    said = vstatics("check", "-", stdin=deck).err
    assert "shift element, or `--allow W414`" in said
    assert "without `UAQ`" in said


def test_a_neutral_gear_that_is_meant_passes_also_strictly() -> None:
    """Its constraints say so: three links and a set leave two degrees of freedom less the input."""
    loaded = f"{MEANT}load: {{speed: 2000 rpm, torque: 90 N*m}}\n"
    for text in (MEANT, loaded, f"{OPEN_GEAR}allow: [W414]\n"):
        assert vstatics("check", "-", "--strict", stdin=text.encode()).is_without_messages()
        assert library.check(io.StringIO(text)) == []
    assert vstatics("check", "-", "--strict", "--allow", "W414", stdin=OPEN_GEAR.encode()).err == ""
    for text, words in ((MEANT, "1 missing, neutral"), (OPEN_GEAR, "1 missing")):
        said = vstatics("check", "-", stdin=text.encode()).out
        assert f"gear N       1 of 2 constraints: {words} (engaged: nothing)" in said
    locked = MEANT.replace("N: {engaged: []", "N: {engaged: [C]")  # turns as a block: ratio 1
    words = "gear N: marked `kind: neutral`, but drives with the ratio 1"
    assert words in vstatics("check", "-", stdin=locked.encode()).err


def test_many_engaged_shift_elements_continue_on_a_line_of_their_own() -> None:
    names = [f"clutch_number_{number}" for number in range(7)]
    clutches = ", ".join(f"{name}: [in, ring]" for name in names)
    text = TWO_SPEED.replace("{B:", f"{{{clutches}, B:") + f"gears: {{1: [{', '.join(names)}]}}\n"
    said = vstatics("check", "-", stdin=text.encode()).out
    assert max(map(len, said.splitlines())) <= 80
    assert " ".join(names) in " ".join(said.split())


def test_a_planet_without_teeth_gets_a_note() -> None:
    """The teeth of two planets in mesh do not follow from sun and ring."""
    case = "links: [a, b, c]\nshift_elements: {B: [b, housing]}\ngears: {1: [B]}\nelements: {P: "
    case += "{kind: double_planet, sun: a, ring: b, carrier: c, teeth: {sun: 30, ring: 90%s}}}\n"
    for teeth, words in (
        ("", "`teeth` has no number for planets inner and outer, so their speeds are unknown"),
        (", inner: 22", "`teeth` has no number for planet outer, so its speed is unknown"),
        (", inner: 22, outer: 24", ""),
    ):
        stdin = (case % teeth).encode()
        notes = [one for one in json_answer("check", "-", stdin=stdin) if one["id"] == "N305"]
        assert [one["message"] for one in notes] == [f"elements.P: {words}"] * bool(words)
        speeds = json_answer("run", "-", stdin=stdin)["planet_speeds"]
        assert ([None] in speeds) == bool(words)
