"""The commands: their options, their exit status, what they say and where."""

from pathlib import Path

import click
import pytest

from tests.commands import CASES, LOCKED, MZKT, json_answer, vstatics
from tests.shipped import PRINTED
from vstatics.core.cli import WITH_LANGUAGES, installed, main

DIFFERENTIAL = str(CASES / "differential.yaml")
IS_DIRECTORY = "cannot be read: Is a directory; expected a file, or for several files './**/*.yaml'"


@pytest.mark.usefixtures("files")
def test_status_is_that_of_the_case() -> None:
    for case, run, check, words in (
        (DIFFERENTIAL, 0, 0, ""),
        ("neutral.yaml", 0, 1, "gear N: neutral: one more shift element must be engaged"),
        ("open.yaml", 0, 0, "A and B impose the same constraint"),
        ("locked.yaml", 0, 0, "gear 1: self-locking"),
        ("tied.yaml", 1, 1, "gear both: tied up: C, B and the input speed"),
        ("bad.yaml", 1, 1, "did you mean `ratio`?"),
        ("nowhere.yaml", 1, 1, "nowhere.yaml: error: cannot be read: No such file"),
        (".", 1, 1, IS_DIRECTORY),
    ):
        for command, status in (("run", run), ("check", check)):
            said = vstatics(command, case)
            assert said.status == status
            assert words in said.err
            assert bool(said.err) == bool(words)


@pytest.mark.usefixtures("files")
def test_a_bad_case_or_gear_does_not_stop_the_others() -> None:
    said = vstatics("run", MZKT, "bad.yaml", "neutral.yaml", "-f", "json")
    first, failed, last = said.json
    assert said.status == 1
    assert first["efficiency"] == pytest.approx(PRINTED["ETA"], abs=0.5e-3)
    assert (set(failed), failed["case"]) == ({"file", "case", "errors"}, "bad.yaml")
    assert "bad.yaml:3:" in failed["errors"][0]
    assert last["ratio"] == [None, pytest.approx(3.5)]  # of the differential 1 - u
    tied = json_answer("run", "tied.yaml")
    assert tied["ratio"] == last["ratio"]
    assert tied["messages"][0].startswith("error: gear both: tied up")
    said = vstatics("run", "neutral.yaml", "bad.yaml", MZKT)
    apart = [f"==> {name} <==\n{vstatics('run', name).out}" for name in ("neutral.yaml", MZKT)]
    assert (said.status, said.out) == (1, "\n".join(apart))
    assert said.err.count("bad.yaml:3:") == 1


@pytest.mark.usefixtures("files")
@pytest.mark.parametrize("form", ["listing", "json", "csv"])
def test_a_bad_case_alone_prints_nothing_on_stdout(form: str) -> None:
    assert vstatics("run", "bad.yaml", "-f", form).gives_nothing()
    said = vstatics("run", "bad.yaml", "nowhere.dat", "-f", form)
    assert (said.status, bool(said.out)) == (1, form != "listing")


def test_coasting_turns_the_reverse_gears_of_the_published_train() -> None:
    """.9014 and .9212, and locked where 1/6 of the power would have to pass: the method."""
    driven = json_answer("run", MZKT, "--coast")
    assert driven["efficiency"][4:] == pytest.approx([0.9014, 0.9212], abs=5e-5)
    assert driven["case"]["coast"] is True
    assert json_answer("run", CASES / "self-locking.yaml", "--coast")["locked"][0] is True
    case = LOCKED.replace("links: 3", "links: 3\ncoast: true").encode()
    assert json_answer("run", "-", stdin=case)["locked"] == [False]
    assert json_answer("run", "-", "--drive", stdin=case)["locked"] == [True]


def test_idle_convention_is_overridden() -> None:
    """D3 turns as one piece in gears 3, 4 and 6; `exact` has 0 there."""
    for idle, signs in (("published", PRINTED["IX"][2]), ("exact", [1, 1, 0, 0, 1, 0])):
        assert json_answer("run", MZKT, "--unloaded", idle)["power_sign"][2] == signs


WRONG = dict.fromkeys(
    [
        *("nonsense", "run", "check", "convert", "convert one.yaml", "compare one.json"),
        *("run - -", "check - -", "compare - -", "run a.dat --format xml", "run a.dat --lang fr"),
        *("run a.dat --from xml", "run a.dat --unloaded never", "check a.dat --coast"),
        *("convert a.dat b.txt", "convert a.dat -", "convert a.dat b.dat --to csv"),
    ],
    "",
) | {
    "summary - -": "standard input",
    "rnu box.yaml": "there is no command `rnu`; did you mean `run`?",
    "box.yaml": "there is no command `box.yaml`; expected a command before a file; commands are new, ",
    "new zf-8hp70": "zf-8hp70 is a template, not a file: expected --template zf-8hp70",
    f"run {DIFFERENTIAL} --gear 1": "No such option '--gear': flow",
    f"run {DIFFERENTIAL} --list": "No such option '--list'.\n",  # unlike --coast and --quiet
    f"convert {DIFFERENTIAL} -o a.json": "No such option '-o': expected `convert IN OUT`.",
    f"flow {DIFFERENTIAL} --gear 9": "Invalid value for --gear: no gear '9'",
    f"flow {MZKT} --gear 1,3": "expected an option for each gear: --gear 1 --gear 3",
    f"explain {DIFFERENTIAL} --gear 9": "Invalid value for --gear: no gear '9'",
    "flow gears/*.yaml": "no file matches `gears/*.yaml`",
    "synth box": "'--sets'. Expected --sets N, or --keep CASE instead.",
    f"report {DIFFERENTIAL} --gears 9 -o a.html": "Invalid value for --gears: no gear '9'",
    f"report {DIFFERENTIAL}": "Expected --output FILE, or --watch instead.",
}


def test_wrong_use_is_2_and_says_how() -> None:
    for line in WRONG:
        said = vstatics(*line.split())
        assert said.is_wrong_use(WRONG[line], "\nError: ")
        assert said.err.startswith("Usage: ")


@pytest.mark.parametrize("group", [[], ["torsion"], ["damage"], ["synth"]])
def test_a_group_alone_shows_its_help(group: list[str]) -> None:
    said = vstatics(*group)
    assert said.is_wrong_use()
    assert said.err == vstatics(*group, "--help").out


def test_a_command_in_one_language_names_those_in_several() -> None:
    """As their own options say it."""
    context = click.Context(main)
    commands = [main.get_command(context, name) for name in main.list_commands(context)]
    spoken = [
        str(command.name)
        for command in commands
        if command and any("--lang" in option.opts for option in command.params)
    ]
    assert sorted(spoken) == sorted(installed(WITH_LANGUAGES))
    for line in ("cycle car.yaml trace.csv", "torsion modes box.yaml", "simulate run.yaml"):
        said = vstatics(*line.split(), "--lang", "ru")
        assert said.is_wrong_use(f"and {installed(WITH_LANGUAGES)[-1]} have it.")


@pytest.mark.parametrize("name", ["a.dat", "a.yaml", "a.yml", "a.JSON", "a", "a.txt"])
def test_format_is_recognised_by_suffix_then_by_content(name: str, folder: Path) -> None:
    path = folder / name
    suffix = {".dat": "deck", ".yml": "yaml"}.get(path.suffix, path.suffix.lower()[1:])
    for kind, word in {"deck": "KJG", "yaml": "YAML", "json": "not JSON"}.items():
        path.write_text(vstatics("convert", MZKT, "-", "--to", kind).out, "utf-8")
        is_other = suffix in ("deck", "yaml", "json") and suffix != kind
        is_readable = not is_other or (suffix, kind) == ("yaml", "json")  # JSON is YAML
        assert vstatics("check", path).status == (0 if is_readable else 1)
        assert vstatics("check", path, "--from", kind).status == 0
        assert vstatics("check", "-", "--from", kind, stdin=b"{x y").fails(word)


def test_a_file_that_is_not_there_gets_the_nearest_of_its_folder(folder: Path) -> None:
    assert vstatics("run", MZKT.with_suffix(".dta")).fails("did you mean `mzkt7922.dat`?")
    far = vstatics("run", MZKT.with_name("gears.dat"))
    assert (far.status, "did you mean" in far.err) == (1, False)
    (folder / "a.dat").touch()
    assert "expected a file, or for several files './**/*.dat'" in vstatics("run", ".").err
    (folder / "box.yaml").symlink_to("gone.yaml")
    assert vstatics("check", "box.yaml").fails("it is a link to gone.yaml, which does not exist")
