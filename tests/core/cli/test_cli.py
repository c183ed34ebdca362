"""The commands: their options, their exit status, what they say and where."""

from __future__ import annotations

from pathlib import Path

import click
import pytest

from tests.commands import CASES, MZKT, Said, json_answer, vstatics
from tests.shipped import PRINTED
from vstatics.core.cli import WITH_LANGUAGES, installed, main

COMMANDS = ["run", "check", "convert", "compare"]


@pytest.mark.usefixtures("files")
@pytest.mark.parametrize(
    ("case", "run", "check", "words"),
    [
        (CASES / "differential.yaml", 0, 0, ""),
        ("neutral.yaml", 0, 1, "gear N: neutral: one more shift element must be engaged"),
        ("open.yaml", 0, 0, "A and B impose the same constraint"),
        ("locked.yaml", 0, 0, "gear 1: self-locking"),
        ("tied.yaml", 1, 1, "gear both: tied up: C, B and the input speed"),
        ("bad.yaml", 1, 1, "did you mean `ratio`?"),
        ("nowhere.yaml", 1, 1, "nowhere.yaml: error: cannot be read: No such file"),
        (
            ".",
            1,
            1,
            ".: error: cannot be read: Is a directory; expected a file, or of several a pattern, "
            "'./**/*.yaml'",
        ),
    ],
)
def test_status_is_that_of_the_case(case: str, run: int, check: int, words: str) -> None:
    for command, status in (("run", run), ("check", check)):
        said = vstatics(command, case)
        assert said.status == status
        assert words in said.err
        assert bool(said.err) == bool(words)


@pytest.mark.usefixtures("files")
def test_a_gear_tied_up_does_not_stop_the_others() -> None:
    """In its low gear the differential has the ratio 1 - u = 3.5."""
    document = json_answer("run", "tied.yaml")
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
        "run a.dat --lang fr",
        "run a.dat --from xml",
        "run a.dat --unloaded never",
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
    assert said.is_wrong_use()
    assert said.err.startswith("Usage: ")
    assert "\nError: " in said.err


@pytest.mark.usefixtures("files")
def test_many_cases_go_on_after_a_bad_one() -> None:
    said = vstatics("run", MZKT, "bad.yaml", "neutral.yaml", "-f", "json")
    first, failed, last = said.json
    assert said.status == 1
    assert first["efficiency"] == pytest.approx(PRINTED["ETA"], abs=0.5e-3)
    assert set(failed) == {"file", "case", "errors"}
    assert failed["case"] == "bad.yaml"
    assert "bad.yaml:3:" in failed["errors"][0]
    assert last["ratio"] == [None, pytest.approx(3.5)]


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


def test_a_command_in_one_language_names_those_in_several() -> None:
    """As their own options say it."""
    context = click.Context(main)
    commands = [main.get_command(context, name) for name in main.list_commands(context)]
    spoken = [
        one.name
        for one in commands
        if one and any("--lang" in option.opts for option in one.params)
    ]
    assert sorted(filter(None, spoken)) == sorted(installed(WITH_LANGUAGES))
    for line in ("cycle car.yaml trace.csv", "torsion modes box.yaml", "simulate run.yaml"):
        said = vstatics(*line.split(), "--lang", "ru")
        words = f"and {installed(WITH_LANGUAGES)[-1]} have it."
        assert said.is_wrong_use(words)


@pytest.mark.parametrize(("typed", "meant"), [("rnu", "run"), ("sumary", "summary")])
def test_a_mistyped_command_gets_the_nearest_one(typed: str, meant: str) -> None:
    said = vstatics(typed, MZKT)
    assert said.is_wrong_use(f"there is no command `{typed}`; did you mean `{meant}`?")


def test_a_file_that_is_not_there_gets_the_nearest_of_its_folder() -> None:
    said = vstatics("run", MZKT.with_suffix(".dta"))
    assert said.fails("did you mean `mzkt7922.dat`?")
    far = vstatics("run", MZKT.with_name("gears.dat"))
    assert (far.status, "did you mean" in far.err) == (1, False)


def test_a_link_to_what_is_not_there_is_no_misspelling(tmp_path: Path) -> None:
    link = tmp_path / "box.yaml"
    link.symlink_to("gone.yaml")
    said = vstatics("check", link)
    assert "it is a link to gone.yaml, which is not there" in said.err


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("report differential.yaml --gears 9 -o a.html", "Invalid value for --gears: no gear '9'"),
        ("flow differential.yaml --gear 9", "Invalid value for --gear: no gear '9'"),
        ("synth box", "'--sets'. Expected --sets N, or --keep CASE instead."),
        ("report differential.yaml", "Expected --output FILE, or --watch instead."),
        ("flow gears/*.yaml", "no file matches `gears/*.yaml`"),
    ],
)
def test_wrong_use_is_told_by_the_option_that_was_typed(line: str, words: str) -> None:
    said = vstatics(*line.replace("differential.yaml", str(CASES / "differential.yaml")).split())
    assert said.is_wrong_use(words)


@pytest.mark.parametrize("group", [[], ["torsion"], ["damage"], ["synth"]])
def test_a_group_alone_shows_its_help(group: list[str]) -> None:
    said = vstatics(*group)
    assert said.is_wrong_use()
    assert said.err == vstatics(*group, "--help").out
