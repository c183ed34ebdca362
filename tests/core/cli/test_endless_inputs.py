"""Inputs without an end: each command reports the file and its bound, soon."""

import os
import time
from collections.abc import Sequence
from pathlib import Path

import pytest

from tests.commands import CASES, process, vstatics
from tests.installed import skip_without

SECONDS = 10
CASE = """\
links: [in, out]
mechanisms: {pair: {first: in, second: out, ratio: 3}}
gears: {drive: []}
load: {speed: 3000 rpm, torque: 100 N*m}
"""
HOSTILE = {
    "endless": ("larger than", "a device, expected a regular file"),
    "large": ("larger than", "larger than"),
    "pipe": ("", "a named pipe (FIFO), expected a regular file"),
}
"""What is said of a file that a user names, and of one that another file names."""
VARIANTS = "sweep box.yaml --variants hostile --out ratio"
BY_USER = (
    *(f"{command} hostile" for command in ("run", "check", "flow", "explain", "summary")),
    *("report hostile -o page.html", "convert hostile new.json", "simulate hostile"),
    *(f"plot -k {kind} hostile -o new.svg" for kind in ("stick", "map", "boxes")),
    *("sweep hostile --vary pair.ratio=1,2 --out ratio", "sweep --file hostile", VARIANTS),
    *("summary box.yaml --duty hostile", "summary box.yaml --duty hostile.csv"),
    *("compare hostile box.yaml", "compare box.yaml hostile", "run --files-from hostile"),
    *("cycle box.yaml hostile", "run hostile.xlsx", "torsion dump hostile"),
    "synth box --keep hostile --ratios 1,2",
)
BY_FILE = {
    "simulate doc.yaml": "{case: hostile, duration: 1}",
    "check doc.yaml": "{case: hostile, duration: 1}",
    "sweep doc.yaml --vary duration=1,2": "{case: hostile, duration: 1}",
    "sweep --file doc.yaml": "{case: hostile, vary: {pair.ratio: '1,2'}}",
    "sweep --file doc.yaml --out ratio": "{case: box.yaml, variants: hostile}",
    "run doc.yaml": f"{CASE}drag: {{out: {{file: hostile}}}}\n",
    "simulate doc.yaml --samples 1": """\
case: box.yaml
duration: 1
start: {speeds: {in: 0, out: 0}}
tables: {map: {file: hostile}}
""",
    "cycle doc.yaml trace.csv": (
        f"{CASE}vehicle: {{mass: 1000, radius: .3, fuel: {{file: hostile}}}}\n"
    ),
}
"""Commands and the document that they read, which names the hostile file."""


@pytest.fixture(params=HOSTILE)
def kind(request: pytest.FixtureRequest, folder: Path) -> str:
    """Kind of a file that has no end, or hardly one."""
    file = folder / "hostile"
    if request.param == "endless":
        file.symlink_to("/dev/zero")
    elif request.param == "pipe":
        os.mkfifo(file)
    else:
        with file.open("wb") as opened:
            opened.truncate(3 * 10**9)
    for suffix in (".csv", ".xlsx"):
        (folder / f"hostile{suffix}").symlink_to("hostile")
    (folder / "box.yaml").write_text(CASE, "utf-8")
    (folder / "trace.csv").write_text("time [s],speed [km/h],gear\n0,0,drive\n9,9,drive\n")
    return str(request.param)


def told(words: Sequence[str]) -> str:
    """What a command says, in time."""
    begin = time.process_time()
    said = vstatics(*words)
    assert time.process_time() - begin < SECONDS
    assert said.fails("hostile"), said
    assert "Traceback" not in said.err
    assert "an error of vstatics" not in said.err
    return said.err


@pytest.mark.parametrize("kind", ["endless", "large"], indirect=True)
@pytest.mark.parametrize("line", BY_USER)
def test_a_file_that_a_user_names_is_read_up_to_its_bound(line: str, kind: str) -> None:
    bound = "line is longer than" if line == VARIANTS else HOSTILE[kind][0]
    assert bound in told(line.split())


@pytest.mark.parametrize("line", BY_FILE)
def test_a_file_that_another_file_names_is_a_regular_file(line: str, kind: str) -> None:
    if "duration:" in BY_FILE[line]:
        skip_without("simulation")
    Path("doc.yaml").write_text(BY_FILE[line])
    is_line = kind == "large" and "variants" in BY_FILE[line]
    assert ("line is longer" if is_line else HOSTILE[kind][1]) in told(line.split())


def test_files_of_a_folder_that_is_compared_are_regular_files(kind: str) -> None:
    Path("folder").mkdir()
    Path("hostile").rename("folder/hostile.json")
    assert HOSTILE[kind][1] in told(["compare", "folder", "folder"])


def test_a_pipe_on_the_command_line_is_read() -> None:
    case = (CASES / "simpson.yaml").read_bytes()
    expected = vstatics("run", CASES / "simpson.yaml").out
    read, write = os.pipe()
    os.write(write, case)
    os.close(write)
    assert vstatics("run", f"/dev/fd/{read}").out == expected
    os.close(read)
    status, _, err = process("run", "-", stdin=b"\n" * 10_000_001)
    assert status == 1
    assert err.startswith(b"<stdin>: error: cannot be read: larger than 10 MB")
