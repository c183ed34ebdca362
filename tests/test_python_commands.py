"""Functions that do what commands do: they say the same."""

import importlib
import inspect
import io
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import vstatics
from tests import commands
from tests.commands import BAD, CASES, NEUTRAL, ROOT, TIED_UP
from tests.installed import ANNEXES, HERE, needs, skip_without
from tests.rejects import rejects
from vstatics.core.annexes import COMMANDS

pytestmark = pytest.mark.usefixtures("folder")

WRITTEN = "written.json"


@pytest.mark.parametrize(
    "text",
    [
        BAD,
        NEUTRAL,
        TIED_UP,
        TIED_UP + "allow: [W101]\n",
        NEUTRAL.replace("gears:", "allow: [W414]\ngears:"),
        (CASES / "wolfrom.yaml").read_text("utf-8"),
    ],
)
def test_check_tells_what_the_command_tells(text: str) -> None:
    Path("box.yaml").write_text(text, "utf-8")
    told = commands.json_answer("check", "box.yaml")
    found = vstatics.check("box.yaml")
    assert [(one.id, one.message) for one in found] == [(one["id"], one["message"]) for one in told]


@needs("simulation")
def test_a_scenario_is_checked_with_its_case() -> None:
    Path("box.yaml").write_text(BAD, "utf-8")
    Path("run.yaml").write_text("{case: box.yaml, duration: 1}", "utf-8")
    assert [one.id for one in vstatics.check("run.yaml")] == ["E190"]
    assert vstatics.check(CASES / "scenarios/tarasik-set-upshift.yaml") == []
    with pytest.raises(OSError, match="nowhere"):
        vstatics.check("nowhere.yaml")


def test_a_text_is_checked_as_its_file_is_and_opens_none() -> None:
    Path("box.yaml").write_text(TIED_UP, "utf-8")
    told, of_file = vstatics.check(io.StringIO(TIED_UP)), vstatics.check("box.yaml")
    assert [one.id for one in told] == [one.id for one in of_file] != []
    assert [(one.message, one.place and one.place[1:]) for one in told] == [
        (one.message, one.place and one.place[1:]) for one in of_file
    ]
    skip_without("simulation")
    run = "{case: box.yaml, duration: 1, start: {speeds: {1: 10}}}"
    (refused,) = vstatics.check(io.StringIO(run))
    assert (refused.id, "cannot name a file" in refused.message) == ("E660", True)
    with pytest.raises(vstatics.ReadError, match="E660"):
        vstatics.load_scenario(io.StringIO(run))
    Path("run.yaml").write_text(run, "utf-8")
    scenario = vstatics.load_scenario("run.yaml", case=io.StringIO(NEUTRAL))
    assert scenario.case == vstatics.loads(NEUTRAL)
    assert vstatics.load_scenario(io.StringIO(run), case="box.yaml").case == vstatics.load(
        "box.yaml"
    )


@needs("simulation")
@pytest.mark.parametrize("line", ["user{}:*:::\n", "user{}:x:0:0::/home:/bin/sh\n"])
def test_of_a_file_of_other_matters_nothing_is_reported(line: str) -> None:
    """A scenario may name any file as its case."""
    Path("users").write_text("".join(map(line.format, range(300))), "utf-8")
    Path("run.yaml").write_text("{case: users, duration: 1}", "utf-8")
    (told,) = vstatics.check("run.yaml")
    assert (told.id, told.message) == ("E660", "users is not a case: it has no key of a case")
    assert told.place is not None
    assert told.place.file == "run.yaml"
    assert "user1" not in commands.vstatics("simulate", "run.yaml").err
    Path("run.yaml").write_text("{case: run.yaml, duration: 1}", "utf-8")
    assert vstatics.check("run.yaml")[0].message.endswith(" is not a case: it is a scenario")


def test_a_transmission_says_what_it_takes() -> None:
    wrong: dict[str, dict[str, Any]] = {
        "`gears` is str 'abc', expected a sequence of a Gear": {"gears": "abc"},
        "`name` is int 5, expected a text": {"name": 5},
        "`outputs` is int 3, expected a sequence of a whole number": {"outputs": 3},
        "expected a sequence of a ShiftElement": {"shift_elements": [1]},
    }
    for why, changes in wrong.items():
        with rejects(TypeError, why):
            vstatics.loads(NEUTRAL).replace(**changes)


def test_check_allows_as_the_command_does() -> None:
    Path("box.yaml").write_text(NEUTRAL, "utf-8")
    assert [one.id for one in vstatics.check("box.yaml")] == ["E453", "W414"]
    assert vstatics.check("box.yaml", allow=["W414"]) == []
    with pytest.raises(ValueError, match="`E190` is an error"):
        vstatics.check("box.yaml", allow=["E190"])


WITHOUT_SCIPY = """
import sys
from importlib import abc, machinery


class Finder(abc.MetaPathFinder):
    def find_spec(self, name, path, target=None):
        if name.partition(".")[0] == "scipy":
            return machinery.PathFinder.find_spec(name, ["shadow"]) or absent(name)


def absent(name):
    raise ModuleNotFoundError(f"No module named {name!r}", name=name)


sys.meta_path.insert(0, Finder())
import vstatics
from vstatics.vehicle.case.fatigue import Fatigue
scenario = vstatics.load_scenario(sys.argv[1])
for call in (
    lambda: vstatics.simulate(scenario),
    lambda: vstatics.rayleigh_life(Fatigue(1e8, 3, 4e6), 6e7),
    lambda: vstatics.torsion.modes,
):
    try:
        call()
    except vstatics.CaseError as error:
        print(error)
"""


@needs("simulation", "torsion", "vehicle")
@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", 'pip install ".['),
        ("import no_such_part", "is installed, but cannot be imported: ModuleNotFoundError: No"),
    ],
)
def test_a_missing_or_broken_package_is_reported_as_by_commands(text: str, words: str) -> None:
    """In each function that cannot do without; a package that fails on import is none of ours."""
    if text:
        Path("shadow/scipy").mkdir(parents=True)
        Path("shadow/scipy/__init__.py").write_text(text, "utf-8")
    scenario = str(CASES / "scenarios/tarasik-set-upshift.yaml")
    call = [sys.executable, "-c", WITHOUT_SCIPY, scenario]
    said = subprocess.run(call, env=commands.environment(), capture_output=True, check=True)
    told = said.stdout.decode().splitlines()
    assert [words in line and line.endswith("[E014]") for line in told] == [True] * 3, told
    assert (".[torsion]" in told[1]) == (not text), "the extra that `damage rayleigh` names"


def test_compare_tells_what_the_command_tells() -> None:
    case, other = vstatics.loads(NEUTRAL), vstatics.loads(NEUTRAL.replace("-2.5", "-3"))
    for name, one in (("old", case), ("new", other)):
        Path(name).mkdir()
        vstatics.save(one, f"{name}.yaml")
        assert commands.vstatics("run", f"{name}.yaml", "-o", f"{name}/{WRITTEN}").status == 0
    [told] = commands.json_answer("compare", "new", "old")["cases"]
    found = vstatics.compare("new", "old")
    assert (found.same, found.changed, found.added, found.gone) == (0, 1, 0, 0)
    assert [one.path for one in found.cases[0].case] == [one["path"] for one in told["case"]]
    files = vstatics.compare(f"new/{WRITTEN}", f"old/{WRITTEN}").cases[0]
    results = vstatics.compare(vstatics.solve(other), vstatics.solve(case)).cases[0]
    assert len(files.numbers) == len(told["numbers"]) > 0
    assert list(results.numbers) == list(files.numbers) == list(found.cases[0].numbers)


@pytest.mark.parametrize("suffix", [".yaml", ".json", ".xlsx", ".dat"])
def test_save_writes_what_convert_writes(suffix: str) -> None:
    source = CASES / "mzkt7922.dat"
    assert commands.vstatics("convert", source, f"told{suffix}").status in (0, 1)
    vstatics.save(vstatics.load(source), f"own{suffix}")
    assert Path(f"own{suffix}").read_bytes() == Path(f"told{suffix}").read_bytes()
    with pytest.raises(ValueError, match=r"box.xls: expected one of the suffixes .dat"):
        vstatics.save(vstatics.load(source), "box.xls")


WITH_NAMES = ("torsion", "simulation", "synthesis")
"""Annexes that have public names beside those of the package."""
PUBLIC = [
    (module, name)
    for module in ("", ".core.elements", *(f".{name}" for name in WITH_NAMES if name in HERE))
    for name in importlib.import_module(f"vstatics{module}").__all__
    if name != "__version__"
]


GIVEN = {
    word
    for module, name in PUBLIC
    if inspect.isfunction(public := getattr(importlib.import_module(f"vstatics{module}"), name))
    for word in re.findall(r"[A-Z]\w+", str(inspect.signature(public).return_annotation))
} | {"Chunk", "GearModes", "Mode", "PowerFlow", "RankedBox", "Trace"}
"""What functions give, and the parts and files of that: it has no example."""


@needs(*ANNEXES)
def test_what_a_function_gives_has_a_public_name() -> None:
    assert GIVEN - {"None", "Any", "Floats", "Iterator"} <= {name for _, name in PUBLIC}


def test_what_is_public_tells_its_arguments_results_errors_and_an_example() -> None:
    """In the form of numpydoc."""
    for module, name in PUBLIC:
        public = getattr(importlib.import_module(f"vstatics{module}"), name)
        text = inspect.getdoc(public) or ""
        if isinstance(public, type):
            assert issubclass(public, Exception) or ">>>" in text or name in GIVEN, name
            continue
        sections = set(re.findall(r"^(\w+)\n-+$", text, re.MULTILINE))
        signature = inspect.signature(public)
        assert signature.return_annotation in (None, "None") or "Returns" in sections, name
        assert {"Raises", "Examples"} <= sections, name
        for argument in signature.parameters:
            assert re.search(rf"^\**([\w*]+, )*{argument}\b", text, re.MULTILINE), (name, argument)


def test_the_page_names_every_command() -> None:
    from vstatics.core.cli import main

    page = (ROOT / "docs/python.md").read_text("utf-8")
    lines = (ROOT / "docs/how-to/commands-in-python.md").read_text("utf-8")
    section = page.partition("\n## Every command\n")[2].partition("\n## ")[0]
    named = {
        word
        for row in section.splitlines()
        if row.startswith("| `")
        for word in row.split("|")[1].split("`")[1::2]
    }
    every = {*main.list_commands(None)}  # type: ignore[arg-type]
    assert every <= named
    headings = re.findall(r"^## (.*)$", lines, re.MULTILINE)
    told = {one for heading in headings for one in heading.split(", ")}
    assert every - {"serve"} == {one for one in told if COMMANDS.get(one, "") in ("", *HERE)}


@pytest.mark.parametrize("seed", [None, 7])
def test_an_exercise_is_that_of_the_command(seed: int | None) -> None:
    made = vstatics.exercise(vstatics.solve(vstatics.example("zf-8hp70")), "R", seed=seed)
    asked = ["explain", str(CASES / "zf-8hp70.yaml"), "--gear", "R"]
    asked += [] if seed is None else ["--seed", str(seed)]
    told = commands.json_answer(*asked, "--solution")
    assert made.document() == told
    assert [one._asdict() for one in made.blanks] == told["blanks"]
    for form in ("text", "markdown", "latex"):
        for option, written in (("--worksheet", made.worksheet), ("--solution", made.solution)):
            said = commands.vstatics(*asked, option, "-f", form, "--lang", "ru")
            assert written(form, lang="ru") == said.out
    assert made._repr_html_().count("____") == len(made.blanks)


def test_an_exercise_is_refused_as_by_the_command() -> None:
    results = vstatics.solve(vstatics.example("simpson"))
    with pytest.raises(ValueError, match="seed is -1, expected 0 or more"):
        vstatics.exercise(results, "1", seed=-1)
    with pytest.raises(ValueError, match="expected 'text', 'markdown' or 'latex'; did you mean"):
        vstatics.exercise(results, "1").worksheet("markdwon")  # type: ignore[arg-type]
