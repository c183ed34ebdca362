"""The program as a process: pipes, full disks, terminals, encodings, closed streams."""

import os
import re
import shutil
from pathlib import Path

import click
import pytest

from tests.commands import (
    CASES,
    MZKT,
    NEUTRAL,
    ROOT,
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


def test_a_build_is_identified_by_the_files_of_the_package(tmp_path: Path) -> None:
    """A copy of them is the same build, a changed byte makes another one."""
    copy = tmp_path / "vstatics"
    shutil.copytree(ROOT / "vstatics", copy, ignore=shutil.ignore_patterns("__pycache__"))

    def told() -> bytes:
        return process("--version", cwd=tmp_path, PYTHONPATH=str(tmp_path))[1]

    assert told() == process("--version")[1]
    (copy / "core" / "cli" / "templates" / "simpson_train.yaml").write_text("#", "utf-8")
    assert told() != process("--version")[1]


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
    status, _, err = shell(f"set +o pipefail; (sleep .5; vstatics {command}; echo $? >&2) | true")
    assert (status, err) == (0, b"1\n")


def test_a_full_disk_is_reported_in_one_line() -> None:
    for command in (
        "run cases/mzkt7922.dat",
        "run cases/mzkt7922.dat cases/umdm.yaml -f jsonl",
        "check cases/differential.yaml",
        "convert cases/mzkt7922.dat - --to yaml",
        "compare tests/golden/umdm-reduced.yaml.lst tests/golden/mzkt7922.dat.lst",
        "--help",
        "--version",
    ):
        full = b"<stdout>: error: cannot be written: No space left on device [E030]\n"
        assert shell(f"vstatics {command} > /dev/full") == (1, b"", full)


def test_closed_streams_are_reported_but_results_come_even_where_messages_cannot() -> None:
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
def test_results_are_utf_8_whatever_python_is_set_to(encoding: str, folder: Path) -> None:
    (folder / "ru.yaml").write_text(RUSSIAN, "utf-8")
    assert vstatics("run", "ru.yaml", "-f", "json", "-o", "a.json").status == 0
    text = Path("a.json").read_text("utf-8").replace("[null, 3.5]", "[null, 3]")
    Path("b.json").write_text(text, "utf-8")
    for line in (
        *("run ru.yaml --lang ru", "run ru.yaml -f json", "run ru.yaml -f csv", "check ru.yaml"),
        "compare a.json b.json",
    ):
        _, out, err = process(*line.split(), cwd=folder, PYTHONIOENCODING=encoding)
        assert "низшая" in out.decode()
        assert b"Traceback" not in err


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


def test_a_terminal_shows_what_a_pipe_gets() -> None:
    assert on_terminal("run", "cases/mzkt7922.dat", cwd=ROOT) == LISTING.decode()
    shown = on_terminal("check", "tests/bad/key-unknown.yaml", cwd=ROOT)
    assert ("did you mean" in shown, "\x1b" in shown) == (True, False)
    for command in ("", "run", "torsion modes"):
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


def test_shell_completion_names_commands_templates_ids_and_tables() -> None:
    for words, names in (
        ("", main.list_commands(click.Context(main))),
        ("new x.yaml -t zf-8", ["zf-8hp70"]),
        ("run --allow w41", ["W414"]),
        ("check --explain w201,E01", ["w201,E013"]),
        ("compare a.json b.json --leave-out los", ["losses"]),
    ):
        status, out, _ = process(
            _VSTATICS_COMPLETE="bash_complete",
            COMP_WORDS=f"vstatics {words}",
            COMP_CWORD=str(words.count(" ") + 1),
        )
        found = re.findall(r"plain,([\w,-]+)", out.decode())
        assert (status, {*names} <= {*found}) == (0, True)
        assert words or found == names
