"""The commands: their options, their exit status, what they say and where."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.commands import BAD, CASES, LOCKED, MZKT, NEUTRAL, TIED_UP, Said, vstatics

COMMANDS = ["run", "check", "convert", "compare"]
REFERENCE = json.loads(
    (Path(__file__).parents[1] / "published" / "mzkt7922.json").read_text(encoding="utf-8")
)


@pytest.fixture
def files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder, the current one, with a case of each kind."""
    for name, text in {
        "neutral.yaml": NEUTRAL,
        "tied.yaml": TIED_UP,
        "locked.yaml": LOCKED,
        "bad.yaml": BAD,
        "open.yaml": NEUTRAL.replace("B: [2, housing]", "B: [2, housing], A: [2, housing]").replace(
            "N: {}", "both: {engaged: [A, B]}"
        ),
    }.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.usefixtures("files")
@pytest.mark.parametrize(
    ("case", "status", "words"),
    [
        (CASES / "differential.yaml", 0, ""),
        ("neutral.yaml", 0, "gear N: 1 condition missing for the speeds (neutral)"),
        ("open.yaml", 0, "A and B: 1 engaged element is in excess"),
        ("locked.yaml", 0, "gear 1: locked by friction"),
        ("tied.yaml", 1, "gear both: tied up: C, B and the input speed"),
        ("bad.yaml", 1, "did you mean `ratio`?"),
        ("nowhere.yaml", 1, "nowhere.yaml: error: can't be read: No such file"),
        (".", 1, ".: error: can't be read: Is a directory"),
    ],
)
@pytest.mark.parametrize("command", ["run", "check"])
def test_status_is_that_of_the_case(command: str, case: str, status: int, words: str) -> None:
    said = vstatics(command, case)
    assert said.status == status
    assert words in said.err
    assert bool(said.err) == bool(words)


@pytest.mark.usefixtures("files")
def test_a_gear_tied_up_does_not_stop_the_others() -> None:
    """In its low gear the differential has the ratio 1 - u = 3.5."""
    document = json.loads(vstatics("run", "tied.yaml", "-f", "json").out)
    assert document["ratio"] == [None, pytest.approx(3.5)]
    assert document["messages"][0].startswith("error: gear both: tied up")


@pytest.mark.parametrize(
    "arguments",
    [
        "nonsense",
        "run",
        "check",
        "convert",
        "convert one.yaml",
        "compare one.json",
        "run - -",
        "check - -",
        "compare - -",
        "run a.dat --format xml",
        "run a.dat --lang de",
        "run a.dat --from xml",
        "run a.dat --idle never",
        "run a.dat --nonsense",
        "check a.dat --coast",
        "convert a.dat b.txt",
        "convert a.dat b",
        "convert a.dat -",
        "convert a.dat b.dat --to csv",
        "compare a b --atol -1",
        "compare a b --rtol nothing",
    ],
)
def test_wrong_use_is_2_and_says_how(arguments: str) -> None:
    said = vstatics(*arguments.split())
    assert (said.status, said.out) == (2, "")
    assert said.err.startswith("Usage: ")
    assert "\nError: " in said.err


@pytest.mark.usefixtures("files")
def test_many_cases_go_on_after_a_bad_one() -> None:
    said = vstatics("run", MZKT, "bad.yaml", "neutral.yaml", "-f", "json")
    first, failed, last = json.loads(said.out)
    assert said.status == 1
    assert first["ETA"] == pytest.approx(REFERENCE["ETA"], abs=0.5e-3)
    assert set(failed) == {"case", "errors"}
    assert failed["case"] == "bad.yaml"
    assert "bad.yaml:3:" in failed["errors"][0]
    assert last["ratio"] == [None, pytest.approx(3.5)]


@pytest.mark.usefixtures("files")
def test_many_listings_follow_one_another_without_the_bad_one() -> None:
    said = vstatics("run", "neutral.yaml", "bad.yaml", MZKT)
    apart = [f"==> {name} <==\n{vstatics('run', name).out}" for name in ("neutral.yaml", MZKT)]
    assert (said.status, said.out) == (1, "\n".join(apart))
    assert said.err.count("bad.yaml:3:") == 1


@pytest.mark.usefixtures("files")
@pytest.mark.parametrize("form", ["listing", "json", "csv"])
def test_a_bad_case_alone_prints_nothing_on_stdout(form: str) -> None:
    said = vstatics("run", "bad.yaml", "-f", form)
    assert (said.status, said.out) == (1, "")
    said = vstatics("run", "bad.yaml", "nowhere.dat", "-f", form)
    assert said.status == 1
    assert bool(said.out) == (form == "json")


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


def test_coasting_turns_the_reverse_gears_of_the_published_train() -> None:
    """.9014 and .9212, and locked where 1/6 of the power would have to pass: the method."""
    driven = json.loads(vstatics("run", MZKT, "--coast", "-f", "json").out)
    assert driven["ETA"][4:] == pytest.approx([0.9014, 0.9212], abs=5e-5)
    assert driven["case"]["coast"] is True
    said = vstatics("run", CASES / "self-locking.yaml", "--coast", "-f", "json")
    assert json.loads(said.out)["locked"][0] is True
    case = LOCKED.replace("links: 3", "links: 3\ncoast: true").encode()
    assert json.loads(vstatics("run", "-", "-f", "json", stdin=case).out)["locked"] == [False]
    said = vstatics("run", "-", "--drive", "-f", "json", stdin=case)
    assert json.loads(said.out)["locked"] == [True]


@pytest.mark.parametrize(("idle", "signs"), [("published", REFERENCE["IX"][2]), ("exact", None)])
def test_idle_convention_is_overridden(idle: str, signs: list[int] | None) -> None:
    """D3 turns as one piece in gears 3, 4 and 6; `exact` has 0 there."""
    said = vstatics("run", MZKT, "--idle", idle, "-f", "json")
    assert json.loads(said.out)["IX"][2] == (signs or [1, 1, 0, 0, 1, 0])


def format_of(said: Said) -> str:
    """Which reader spoke, by its words for the same fault."""
    kinds = {"KJG": "deck", "not JSON": "json", "YAML": "yaml", "links": "yaml"}
    return next((kind for word, kind in kinds.items() if word in said.err), "none")


@pytest.mark.parametrize(
    "name", ["case.dat", "case.yaml", "case.yml", "case.JSON", "case", "c.txt"]
)
def test_format_is_told_by_suffix_then_by_content(name: str, tmp_path: Path) -> None:
    path = tmp_path / name
    suffix = {".dat": "deck", ".yml": "yaml"}.get(path.suffix, path.suffix.lower()[1:])
    texts = {kind: vstatics("convert", MZKT, "-", "--to", kind).out for kind in FORMATS}
    for kind, text in texts.items():
        path.write_text(text, encoding="utf-8")
        told = suffix in FORMATS and suffix != kind
        readable = not told or (suffix, kind) == ("yaml", "json")  # JSON is YAML
        assert vstatics("check", path).status == (0 if readable else 1)
        assert vstatics("check", path, "--from", kind).status == 0


FORMATS = ("deck", "yaml", "json")


@pytest.mark.parametrize("form", FORMATS)
def test_the_reader_asked_for_is_the_one_that_speaks(form: str) -> None:
    assert format_of(vstatics("check", "-", "--from", form, stdin=b"{x y")) == form
