"""The program as a process: pipes, full disks, terminals, encodings, closed streams."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import click
import pytest

from tests.commands import (
    CASES,
    MZKT,
    NEUTRAL,
    ROOT,
    environment,
    on_terminal,
    process,
    shell,
    vstatics,
)
from vstatics import __version__
from vstatics.core.cli import main
from vstatics.core.extras import build

pytestmark = pytest.mark.slow  # each starts the program anew
RUSSIAN = NEUTRAL.replace("links: 3", "name: коробка\nlinks: 3").replace("low:", "низшая:")
LISTING = vstatics("run", MZKT).out.encode()


def test_python_m_is_the_same_program() -> None:
    assert process("run", MZKT) == (0, LISTING, b"")
    words = f"vstatics, version {__version__}, build {build()}\n"
    assert process("--version") == (0, words.encode(), b"")


def test_a_build_is_told_by_the_files_of_the_package(tmp_path: Path) -> None:
    """A copy of them is the same build, a changed byte makes another one."""
    copy = tmp_path / "vstatics"
    shutil.copytree(ROOT / "vstatics", copy, ignore=shutil.ignore_patterns("__pycache__"))

    def told() -> bytes:
        return process("--version", cwd=tmp_path, PYTHONPATH=str(tmp_path))[1]

    assert told() == process("--version")[1]
    (copy / "core" / "cli" / "templates" / "simpson_train.yaml").write_text("#", "utf-8")
    assert told() != process("--version")[1]


@pytest.mark.parametrize("form", ["listing", "json", "csv", "jsonl"])
def test_no_result_tells_a_build(form: str) -> None:
    assert build() not in vstatics("run", MZKT, "-f", form).out


def test_a_case_comes_through_a_pipe() -> None:
    golden = "tests/golden/mzkt7922.dat.json"
    for line, out in {
        "cat cases/mzkt7922.dat | vstatics run -": LISTING,
        "vstatics run cases/mzkt7922.dat | vstatics run -": LISTING,
        "cat cases/mzkt7922.dat | vstatics run /dev/stdin": LISTING,
        "vstatics run <(cat cases/mzkt7922.dat)": LISTING,
        f"vstatics run cases/mzkt7922.yaml | vstatics compare - {golden}": b"",
    }.items():
        assert shell(line) == (0, out, b""), line


@pytest.mark.parametrize("command", ["run cases/mzkt7922.dat", "check cases/differential.yaml"])
def test_a_reader_that_has_seen_enough_ends_the_program_quietly(command: str) -> None:
    status, out, err = shell(f"vstatics {command} | head -n 1")
    assert (status in (0, 1), err, out.count(b"\n")) == (True, b"", 1)
    read, write = os.pipe()
    os.close(read)
    line = [sys.executable, "-m", "vstatics", *command.split()]
    with os.fdopen(write, "wb") as closed:
        done = subprocess.run(
            line, stdout=closed, stderr=subprocess.PIPE, check=False, cwd=ROOT, env=environment()
        )
    assert (done.returncode, done.stderr) == (1, b"")


@pytest.mark.parametrize(
    "command",
    [
        "run cases/mzkt7922.dat",
        "run cases/mzkt7922.dat cases/umdm.yaml -f json",
        "run cases/mzkt7922.dat cases/umdm.yaml -f jsonl",
        "check cases/differential.yaml",
        "convert cases/mzkt7922.dat - --to yaml",
        "compare tests/golden/umdm-reduced.yaml.lst tests/golden/mzkt7922.dat.lst",
        "--help",
        "--version",
        "run --help",
    ],
)
def test_a_full_disk_is_told_in_one_line(command: str) -> None:
    full = b"<stdout>: error: cannot be written: No space left on device [E030]\n"
    assert shell(f"vstatics {command} > /dev/full") == (1, b"", full)


def test_closed_streams_are_told_but_results_come_even_where_messages_cannot() -> None:
    closed = b"<stdin>: error: cannot be read: it is closed [E006]\n"
    for command in ("run -", "check -", "convert - - --to deck", f"compare - {MZKT}"):
        assert shell(f"vstatics {command} <&-") == (1, b"", closed)
    bad_file = closed.replace(b"it is closed", b"Bad file descriptor")
    assert shell("vstatics run - 0> /dev/null")[::2] == (1, bad_file)
    line = b"<stdout>: error: cannot be written: it is closed [E030]\n"
    assert shell("vstatics run cases/mzkt7922.dat >&-") == (1, b"", line)
    assert shell("vstatics run nowhere.dat 2>&-")[0] == 1
    case = str(CASES / "self-locking.yaml")
    results = vstatics("run", case).out.encode()
    for stream in ("2> /dev/full", "2>&-"):
        assert shell(f"vstatics run {case} {stream}") == (0, results, b"")


@pytest.mark.parametrize("encoding", ["ascii", "cp1251"])
def test_results_are_utf_8_whatever_python_is_told(encoding: str, tmp_path: Path) -> None:
    (tmp_path / "ru.yaml").write_text(RUSSIAN, "utf-8")
    for arguments in (["run", "--lang", "ru"], ["run", "-f", "json"], ["run", "-f", "csv"]):
        _, out, err = process(*arguments, "ru.yaml", cwd=tmp_path, PYTHONIOENCODING=encoding)
        assert "низшая" in out.decode()
        assert b"Traceback" not in err
    _, out, _ = process("check", "ru.yaml", cwd=tmp_path, PYTHONIOENCODING=encoding)
    assert "gear низшая" in out.decode()
    process("run", "ru.yaml", "-f", "json", "-o", "a.json", cwd=tmp_path)
    text = (tmp_path / "a.json").read_text("utf-8")
    (tmp_path / "b.json").write_text(text.replace("[null, 3.5]", "[null, 3]"), "utf-8")
    status, out, _ = process("compare", "a.json", "b.json", cwd=tmp_path, PYTHONIOENCODING=encoding)
    assert status == 1
    assert any(one.split()[:2] == ["ratio", "низшая"] for one in out.decode().splitlines())


def test_a_name_of_a_file_may_be_any_bytes(tmp_path: Path) -> None:
    name = os.fsdecode(b"\xff.yaml")
    (tmp_path / name).write_text(NEUTRAL, "utf-8")
    assert process("check", name, cwd=tmp_path)[1].startswith(b"\\udcff.yaml: 3 links")
    status, out, err = process("run", os.fsdecode(b"\xfe"), name, "-f", "json", cwd=tmp_path)
    assert (status, b"Traceback" in err) == (1, False)
    assert b'"case": "\\udcfe"' in out
    pytest.importorskip("pyarrow")
    assert process("run", name, "-q", "-o", "all.parquet", cwd=tmp_path)[::2] == (0, b"")
    assert b"\\udcff.yaml" in (tmp_path / "all.parquet").read_bytes()


@pytest.mark.parametrize("variables", [{}, {"NO_COLOR": "1"}], ids=["colour", "NO_COLOR"])
def test_a_terminal_shows_what_a_pipe_gets(variables: dict[str, str]) -> None:
    assert on_terminal("run", "cases/mzkt7922.dat", cwd=ROOT, **variables) == LISTING.decode()
    shown = on_terminal("check", "tests/bad/key-unknown.yaml", cwd=ROOT, **variables)
    assert "did you mean" in shown
    assert "\x1b" not in shown


@pytest.mark.parametrize("command", ["", "run", "torsion modes"])
def test_help_fits_a_terminal_without_colours(command: str) -> None:
    shown = on_terminal(*command.split(), "--help")
    assert max(map(len, shown.splitlines())) <= 80
    assert "\x1b" not in shown


def test_shell_completion_is_produced() -> None:
    for which, words in (
        ("bash", "complete -o nosort -F"),
        ("zsh", "#compdef vstatics"),
        ("fish", "complete --no-files"),
    ):
        status, out, _ = process(_VSTATICS_COMPLETE=f"{which}_source")
        assert (status, words in out.decode()) == (0, True)


@pytest.mark.parametrize(
    ("words", "names"),
    [
        ("", main.list_commands(click.Context(main))),
        ("new x.yaml -t zf-8", ["zf-8hp70"]),
        ("run --allow w41", ["W414"]),
        ("check --explain w201,E01", ["w201,E013"]),
        ("compare a.json b.json --leave-out los", ["losses"]),
    ],
)
def test_shell_completion_names_commands_templates_ids_and_tables(
    words: str, names: list[str]
) -> None:
    status, out, _ = process(
        _VSTATICS_COMPLETE="bash_complete",
        COMP_WORDS=f"vstatics {words}",
        COMP_CWORD=str(words.count(" ") + 1),
    )
    found = re.findall(r"plain,([\w,-]+)", out.decode())
    assert (status, {*names} <= {*found}) == (0, True)
    assert words or found == names
