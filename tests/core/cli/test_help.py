"""Help texts: examples run as printed, options are under headings, former names of options work."""

import inspect
import re
import shutil
from collections.abc import Iterator
from pathlib import Path

import click
import pytest
from click.testing import CliRunner

from tests.commands import CASES, vstatics
from tests.installed import HERE, missing, skip_without, used_in
from tests.test_readme import prepared, run_all
from vstatics.core.cli import main
from vstatics.core.cli.shared.options import HeadedCommand, RenamedOption

GEARBOX = "vstatics new gearbox.yaml --template zf-8hp70"
"""Command that writes the case of the examples, from the help of the program."""
ENDLESS = "vstatics serve"
"""Commands that run until they are stopped."""


def walk(command: click.Command, name: str) -> Iterator[tuple[str, click.Command]]:
    """Yield a command and the commands of a group, with their full names."""
    yield name, command
    if isinstance(command, click.Group):
        context = click.Context(command, info_name=name)
        for inner in command.list_commands(context):
            found = command.get_command(context, inner)
            assert found is not None
            yield from walk(found, f"{name} {inner}".strip())


COMMANDS = dict(walk(main, ""))
"""All commands by name; the name of the program is left out."""


def examples(command: click.Command) -> list[str]:
    """Return the commands in the indented lines of a help text, which can be continued."""
    lines = inspect.cleandoc(command.help or "").splitlines()
    found: list[str] = []
    for line in lines:
        if found and (found[-1].endswith("\\") or found[-1].count("'") % 2):
            found[-1] += f"\n{line}"
        elif re.match(r"  (?:vstatics|cat|echo|find|git|mkdir|printf) ", line):
            found.append(line.strip())
    return found


@pytest.mark.slow
@pytest.mark.skipif(
    not (shutil.which("bash") and shutil.which("jq")), reason="bash or jq is missing"
)
@pytest.mark.parametrize("name", COMMANDS)
def test_examples_of_a_help_text_run(name: str, tmp_path: Path) -> None:
    folder = prepared(tmp_path)
    for shipped in ("cases", "schemas"):
        (folder / shipped).unlink()  # the examples have the files that they write
    if "synthesis" in HERE and "synth box" in (COMMANDS[name].help or ""):
        from vstatics.synthesis.boxes.batches.found import prepare
        from vstatics.synthesis.boxes.box import BoxSearch

        prepare(BoxSearch(1, 2, 1, (3.0, 1.0)))  # compile before the time limit of the examples
    asked = [GEARBOX, *examples(COMMANDS[name])] if name else examples(main)
    asked = [line for line in asked if not line.startswith(ENDLESS)]
    asked = [line for line in asked if not missing(used_in(line))]
    lines = [f"{line}\necho status $?" for line in asked]
    lines[0] = f"set -o pipefail; git init -q .; {lines[0]}; git add -A"
    failed = [
        f"$ {line}\n{output}"
        for line, output in zip(asked, run_all(lines, folder, seconds=600), strict=True)
        if output.splitlines()[-1:] != ["status 0"]
    ]
    assert not failed, "\n".join(failed)


@pytest.mark.parametrize("name", COMMANDS)
def test_a_help_text_has_examples_under_80_columns_by_either_option(name: str) -> None:
    first = name.split(maxsplit=1)[0] if name else ""
    assert [line for line in examples(COMMANDS[name]) if f"vstatics {first}" in line], name
    shown = vstatics(*name.split(), "--help").out
    assert re.search(r"\n  Examples?(, in CI)?:\n    (vstatics|cat|echo|find|git|mkdir) ", shown)
    assert max(map(len, shown.splitlines())) <= 80
    assert vstatics(*name.split(), "-h").out == shown


@pytest.mark.parametrize(
    "name", [name for name, command in COMMANDS.items() if not isinstance(command, click.Group)]
)
def test_options_are_under_headings(name: str) -> None:
    command = COMMANDS[name]
    assert isinstance(command, HeadedCommand)
    headings = re.findall(r"(?m)^(\w[\w ]*):$", vstatics(*name.split(), "--help").out)
    if sum(isinstance(option, click.Option) for option in command.params) <= 6:
        assert headings == ["Options"]
    else:
        assert len(headings) == len({*headings}) > 1
        assert headings[-1] == "Help"


def test_exit_statuses_of_all_commands_are_stated_once() -> None:
    statuses = r"\b0 +success|\b2 +wrong use"
    stated = [name for name, one in COMMANDS.items() if re.search(statuses, one.help or "")]
    assert stated == [""]


FORMER = [
    ("synth box", "--shift-elements", "--elements", ["2"]),
    ("synth box", "--double-pinion", "--meshed", ["1"]),
    ("synth box", "--step-ratios", "--steps", ["1.2:1.8"]),
    ("synth combinations", "--shift-elements", "--elements", ["auto"]),
    ("run", "--unloaded", "--idle", ["exact"]),
    ("summary", "--gearbox", "--box", ["1,4"]),
    ("plot", "--teeth", "--wheels", []),
    ("simulate", "--time-step", "--step", ["0.1"]),
    ("cycle", "--time-steps", "--steps", ["steps.csv"]),
]
"""Command, option, former name and a value of each renamed option."""


def test_a_former_name_works_but_is_neither_listed_nor_completed() -> None:
    for name, option, former, value in FORMER:
        if missing(used_in(f"vstatics {name} {option}")):
            pytest.skip("the annex of the option is not installed")
        command = COMMANDS[name]
        [renamed] = [one for one in command.params if option in one.opts]
        values = [
            command.make_context(name, arguments, resilient_parsing=True).params[str(renamed.name)]
            for arguments in ([option, *value], [former, *value], [])
        ]
        assert values[0] == values[1] != values[2]
        shown = vstatics(*name.split(), "--help").out
        assert re.search(rf"{option}\b", shown)
        assert not re.search(rf"(?<!\w){former}\b", shown)
        words = ["vstatics", *name.split(), "--"]
        asked = {"COMP_WORDS": " ".join(words), "COMP_CWORD": str(len(words) - 1)}
        asked["_VSTATICS_COMPLETE"] = "bash_complete"
        completed = CliRunner().invoke(main, prog_name="vstatics", env=asked).output.split()
        assert (f"plain,{option}" in completed, f"plain,{former}" in completed) == (True, False)


def test_all_former_names_are_tried() -> None:
    every = {
        name
        for command in COMMANDS.values()
        for option in command.params
        if isinstance(option, RenamedOption)
        for name in option.former
    }
    assert every <= {former for _, _, former, _ in FORMER}


@pytest.mark.slow
def test_plot_names_the_files_of_further_pages(tmp_path: Path) -> None:
    skip_without("pictures")
    call = ("plot", CASES / "zf-9hp48.yaml", "-k", "flow", "-o", tmp_path / "flow.svg")
    assert "flow.svg continues in " in vstatics(*call).err
    assert (tmp_path / "flow-2.svg").exists()
    assert "continues" not in vstatics(*call, "-q").err
