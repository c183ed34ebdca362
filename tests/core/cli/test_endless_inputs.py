"""Inputs without an end: each command reports the file and its bound, soon."""

from __future__ import annotations

import os
import time
from pathlib import Path
from typing import NamedTuple

import pytest

from tests.commands import CASES, process, vstatics
from tests.installed import skip_without

SECONDS = 10
CASE = """\
links: [in, out]
mechanisms: {pair: {first: in, second: out, ratio: 3}}
gears: {drive: []}
vehicle: {mass: 1000, radius: .3, fuel: {file: HOSTILE}}
load: {speed: 3000 rpm, torque: 100 N*m}
"""
LAW = CASE.replace(", fuel: {file: HOSTILE}", "") + "drag: {out: {file: HOSTILE}}\n"
TABLE = """\
case: box.yaml
duration: 1
start: {speeds: {in: 0, out: 0}}
tables: {map: {file: HOSTILE}}
"""
HOSTILE = {
    "endless": ("larger than", "a device, expected a regular file"),
    "large": ("larger than", "larger than"),
    "pipe": ("", "a named pipe (FIFO), expected a regular file"),
}
"""What is said of a file that a user names, and of one that another file names."""


def hostile(folder: Path, kind: str) -> Path:
    """A file that has no end, or hardly one."""
    file = folder / "hostile"
    if kind == "endless":
        file.symlink_to("/dev/zero")
    elif kind == "pipe":
        os.mkfifo(file)
    else:
        with file.open("wb") as opened:
            opened.truncate(3 * 10**9)
    return file


class Call(NamedTuple):
    """A command, and the document that it reads."""

    words: str
    document: str = ""
    said: str = ""
    """Where it is not the bound of a file."""


BY_USER = {
    "run": Call("run hostile"),
    "check": Call("check hostile"),
    "flow": Call("flow hostile"),
    "explain": Call("explain hostile"),
    "summary": Call("summary hostile"),
    "report": Call("report hostile -o page.html"),
    "convert": Call("convert hostile new.json"),
    "plot": Call("plot -k stick hostile -o new.svg"),
    "map": Call("plot -k map hostile -o new.svg"),
    "boxes": Call("plot -k boxes hostile -o new.svg"),
    "simulate": Call("simulate hostile"),
    "sweep": Call("sweep hostile --vary pair.ratio=1,2 --out ratio"),
    "sweep file": Call("sweep --file hostile"),
    "variants": Call("sweep box.yaml --variants hostile --out ratio", said="line is longer than"),
    "duty": Call("summary box.yaml --duty hostile"),
    "points": Call("summary box.yaml --duty hostile.csv"),
    "compare": Call("compare hostile box.yaml"),
    "compared": Call("compare box.yaml hostile"),
    "list": Call("run --files-from hostile"),
    "cycle": Call("cycle box.yaml hostile"),
    "workbook": Call("run hostile.xlsx"),
    "modes": Call("torsion modes hostile"),
    "dump": Call("torsion dump hostile"),
    "teeth": Call("synth teeth hostile --ratios drive=2"),
    "boxes kept": Call("synth box --keep hostile --ratios 1,2"),
}
BY_FILE = {
    "case": Call("simulate doc.yaml", "{case: HOSTILE, duration: 1}"),
    "checked": Call("check doc.yaml", "{case: HOSTILE, duration: 1}"),
    "swept": Call("sweep doc.yaml --vary duration=1,2", "{case: HOSTILE, duration: 1}"),
    "sweep file": Call("sweep --file doc.yaml", "{case: HOSTILE, vary: {pair.ratio: '1,2'}}"),
    "variants": Call(
        "sweep --file doc.yaml", "{case: box.yaml, variants: HOSTILE, out: ratio}", "line is longer"
    ),
    "law": Call("run doc.yaml", LAW),
    "table": Call("simulate doc.yaml", TABLE),
    "fuel": Call("cycle doc.yaml trace.csv", CASE),
}


def told(folder: Path, monkeypatch: pytest.MonkeyPatch, call: Call) -> str:
    """What a command says, in time."""
    monkeypatch.chdir(folder)
    for suffix in (".csv", ".xlsx"):
        (folder / f"hostile{suffix}").symlink_to("hostile")
    (folder / "box.yaml").write_text(LAW.partition("drag")[0], encoding="utf-8")
    (folder / "trace.csv").write_text("time [s],speed [km/h],gear\n0,0,drive\n9,9,drive\n")
    (folder / "doc.yaml").write_text(call.document.replace("HOSTILE", "hostile"))
    begin = time.process_time()
    said = vstatics(*call.words.split())
    assert time.process_time() - begin < SECONDS
    assert said.status == 1, said.err
    assert "hostile" in said.err
    assert "Traceback" not in said.err
    assert "an error of vstatics" not in said.err
    return said.err


@pytest.mark.parametrize("kind", ["endless", "large"])
@pytest.mark.parametrize("name", BY_USER)
def test_a_file_that_a_user_names_is_read_up_to_its_bound(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str, kind: str
) -> None:
    hostile(tmp_path, kind)
    call = BY_USER[name]
    assert (call.said or HOSTILE[kind][0]) in told(tmp_path, monkeypatch, call)


@pytest.mark.parametrize("kind", HOSTILE)
@pytest.mark.parametrize("name", BY_FILE)
def test_a_file_that_another_file_names_is_a_regular_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str, kind: str
) -> None:
    if name == "checked":
        skip_without("simulation")
    hostile(tmp_path, kind)
    call = BY_FILE[name]
    said = told(tmp_path, monkeypatch, call)
    assert ((kind == "large" and call.said) or HOSTILE[kind][1]) in said


@pytest.mark.parametrize("kind", HOSTILE)
def test_files_of_a_folder_that_is_compared_are_regular_files(tmp_path: Path, kind: str) -> None:
    hostile(tmp_path, kind).rename(tmp_path / "a.json")
    said = vstatics("compare", tmp_path, tmp_path)
    assert said.fails(HOSTILE[kind][1])


def test_a_pipe_on_the_command_line_is_read() -> None:
    case = (CASES / "simpson.yaml").read_bytes()
    expected = vstatics("run", CASES / "simpson.yaml").out
    read, write = os.pipe()
    os.write(write, case)
    os.close(write)
    assert vstatics("run", f"/dev/fd/{read}").out == expected
    os.close(read)
    status, out, _ = process("run", "-", stdin=case)
    assert (status, out.decode()) == (0, expected)
    status, _, err = process("run", "-", stdin=b"\n" * 10_000_001)
    assert status == 1
    assert err.startswith(b"<stdin>: error: cannot be read: larger than 10 MB")
