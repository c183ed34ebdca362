"""`vstatics torsion` as a process: at a terminal, in a pipe, and what is imported."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

from tests.commands import environment, on_terminal, shell
from tests.torsion.cli.torsional import GOOD, said

pytestmark = pytest.mark.slow  # each starts the program anew
SIMPLIFY = ("simplify", "--gear", "direct", "--links", "2")


@pytest.fixture(autouse=True)
def _files(folder: Path) -> None:
    """A folder with the case, the current one."""
    (folder / "box.yaml").write_text(GOOD, encoding="utf-8")


@pytest.mark.parametrize("call", [("modes",), SIMPLIFY])
def test_a_terminal_shows_what_a_pipe_gets(call: tuple[str, ...]) -> None:
    shown = on_terminal("torsion", call[0], "box.yaml", *call[1:], cwd=Path.cwd())
    assert shown == said(*call, text=GOOD).out


@pytest.mark.parametrize("command", ["run", "check"])
def test_other_commands_start_without_the_room(command: str) -> None:
    """Start-up time: see docs/architecture.md."""
    code = (
        "import sys; from vstatics.core.cli import main\n"
        f"main(['{command}', 'box.yaml'], standalone_mode=False)\n"
        "late = ('scipy', 'vstatics.torsion', 'vstatics.torsion.cli')\n"
        "print(*[name for name in sys.modules if name.startswith(late)], file=sys.stderr)"
    )
    assert python(code) == "\n"


def test_the_help_of_the_group_imports_no_command() -> None:
    code = (
        "import sys; from vstatics.core.cli import main\n"
        "main(['torsion', '--help'], standalone_mode=False)\n"
        "late = ('scipy', 'vstatics.torsion')\n"
        "late = [name for name in sys.modules if name.startswith(late)]\n"
        "group = 'vstatics.torsion.cli.group'\n"
        "packages = {'vstatics.torsion', 'vstatics.torsion.annex', 'vstatics.torsion.cli'}\n"
        "print(*{*late} - packages - {group}, file=sys.stderr)"
    )
    assert python(code) == "\n"


def python(code: str) -> str:
    """What a program says to stderr."""
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, env=environment()
    )
    return done.stderr


def test_commands_go_together_in_a_shell() -> None:
    folder = Path.cwd()
    line = f"cat {folder}/box.yaml | vstatics torsion simplify - --gear direct --links 3"
    status, _, err = shell(f"{line} -o {folder}/simple.yaml && vstatics run {folder}/simple.yaml")
    assert (status, err) == (0, b"")
    status, out, _ = shell(f"vstatics torsion modes {folder}/simple.yaml -f json | cat")
    assert (status, len(json.loads(out)["gears"][0]["modes"])) == (0, 3)


def test_a_reader_that_has_seen_enough_ends_the_program_quietly() -> None:
    status, out, err = shell(f"vstatics torsion modes {Path.cwd()}/box.yaml | head -n 1")
    assert (status in (0, 1), out, err) == (True, b"two gears\n", b"")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no /dev/full here")
def test_a_full_disk_is_told_in_one_line() -> None:
    words = b"<stdout>: error: cannot be written: No space left on device [E030]\n"
    assert shell(f"vstatics torsion modes {Path.cwd()}/box.yaml > /dev/full") == (1, b"", words)
