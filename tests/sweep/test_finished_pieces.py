"""Finished pieces of a sweep: taken up again, held by one process, not lost."""

import contextlib
import json
import resource
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.chance import count, seeded
from tests.commands import environment, json_file
from tests.processes import names
from tests.sweep.sweeps import plan
from vstatics.core.errors import ReadError
from vstatics.core.jobs import piece_file
from vstatics.core.jobs.alone import Alone
from vstatics.core.jobs.finished_pieces import FinishedPieces
from vstatics.sweep.output import Output, description

VARY = ("D.ratio=-4:-2:30",)


def store(path: Path, *, resume: bool = False, vary: str = VARY[0], **more: Any) -> Output:
    """The output of 30 variants in pieces of 8, opened."""
    made = plan(vary, piece=8, **more)
    opened = FinishedPieces(str(path))
    opened.open(description(made, "csv"), made.pieces, resume=resume)
    return Output(made, "csv", opened)


def finished(path: Path, *, resume: bool = False, vary: str = VARY[0]) -> Output:
    """The output with all pieces calculated, as a process leaves it that ends before the rest."""
    written = store(path, resume=resume, vary=vary)
    calculate(written)
    written.store.unlock()
    return written


def calculate(written: Output) -> list[int]:
    told: list[int] = []
    written.calculate(Alone(written.task, written.task.describe), told.append)
    return told


def assemble(written: Output) -> None:
    written.assemble(Alone(written.task, written.task.describe))


def whole(folder: Path) -> bytes:
    written = store(folder / "whole.csv")
    calculate(written)
    assemble(written)
    return (folder / "whole.csv").read_bytes()


def test_pieces_of_another_sweep_of_the_same_layout_are_calculated_again(tmp_path: Path) -> None:
    """Random pieces are replaced with those of a sweep that differs in one number alone."""
    expected = whole(tmp_path)
    rng = seeded(0)
    for trial in range(count(6, 200)):
        path, other = (tmp_path / f"{name}{trial}.csv" for name in ("out", "other"))
        last = rng.choice((-2.0, -1.9, -2.5))
        ends = finished(other, vary=f"D.ratio=-4:{last!r}:30"), finished(path)
        replaced = sorted(rng.sample(range(4), rng.randint(1, 4)))
        for piece in replaced:
            name = piece_file.piece_name(piece)
            source, target = (Path(end.store.directory) / name for end in ends)
            target.write_bytes(source.read_bytes())
        again = store(path, resume=True)
        assert list(again.pending) == ([] if last == -2 else replaced)
        calculate(again)
        assemble(again)
        assert path.read_bytes() == expected


def test_what_a_killed_process_left_unfinished_is_removed(tmp_path: Path) -> None:
    path = tmp_path / "out.csv"
    folder = Path(finished(path).store.directory)
    for name in ("00000001.999.tmp", piece_file.ASSEMBLED, "00000002"):
        (folder / name).write_bytes(b"half")
    assert list(store(path, resume=True).pending) == [2]
    assert names(folder) == [f"0000000{n}" for n in (0, 1, 3)] + ["lock", "plan.json"]


def test_pieces_that_are_not_asked_for_are_not_lost(tmp_path: Path) -> None:
    file = str(tmp_path / "out.csv")
    folder = Path(finished(tmp_path / "out.csv").store.directory)
    before = names(folder)
    wanted: list[tuple[dict[str, Any], str]] = [
        ({}, "holds 4 of 4 finished pieces of this sweep.*--resume"),
        ({"out": "ratio"}, "of another sweep: columns changed; .*remove the directory"),
        ({"where": "ratio[low] > 3"}, "of another sweep: where changed"),
        ({"coast": True}, "of another sweep: the case, a file that it names, or an option"),
    ]
    for more, words in wanted:
        other = plan(*VARY, piece=8, **more)
        with pytest.raises(ReadError, match=words), FinishedPieces(file) as opened:
            opened.open(description(other, "csv"), other.pieces, resume=bool(more))
        assert not opened.is_open  # so the command does not say that it can go on
        assert names(folder) == before
    (tmp_path / "a.csv.parts").mkdir()
    letter = tmp_path / "a.csv.parts/letter.txt"
    letter.write_text("dear", "utf-8")
    with pytest.raises(ReadError, match="contains no sweep"):
        store(tmp_path / "a.csv", resume=True)
    assert letter.read_text("utf-8") == "dear"
    with pytest.raises(IsADirectoryError):
        store(tmp_path)


def test_pieces_of_another_build_are_calculated_again_with_a_word(tmp_path: Path) -> None:
    """Before builds were told the description had none, and another fingerprint."""
    made = plan(*VARY, piece=8)
    for build in ({"build": "0123456789ab"}, {}):
        written = finished(tmp_path / "out.csv", resume=True)
        file = Path(written.store.path("plan.json"))
        known = {**json_file(file), "fingerprint": "other"}
        known.pop("build")
        file.write_text(json.dumps({**known, **build}), "utf-8")
        with FinishedPieces(str(tmp_path / "out.csv")) as opened:
            with pytest.raises(ReadError, match=r"of this sweep, .*--resume"):
                opened.open(description(made, "csv"), made.pieces, resume=False)
            opened.unlock()
            without = opened.open(description(made, "csv"), made.pieces, resume=True)
            assert without == "the finished work belongs to another build of vstatics"
            assert opened.finished() == []


def test_pieces_go_when_the_output_is_on_the_disk(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A disk may refuse as late as that; then the output is as it was, and no piece is lost."""
    path = tmp_path / "out.csv"
    path.write_bytes(b"old")
    written = store(path)
    calculate(written)
    synced = []
    with monkeypatch.context() as patch:
        patch.setattr("os.fsync", lambda _: (_ for _ in ()).throw(OSError(5, "I/O error")))
        with pytest.raises(OSError, match="I/O error"):
            assemble(written)
    assert (path.read_bytes(), len(written.store.finished())) == (b"old", 4)
    with monkeypatch.context() as patch:
        patch.setattr("os.fsync", lambda _: synced.append(len(written.store.finished())))
        assemble(written)
    assert synced == [4, 4]  # the file, then the folder
    assert names(tmp_path) == ["out.csv"]


def test_where_nothing_is_finished_nothing_stays(tmp_path: Path) -> None:
    with store(tmp_path / "out.csv").store:
        assert names(tmp_path) == ["out.csv.parts"]
    assert names(tmp_path) == []


@pytest.mark.slow
def test_two_sweeps_do_not_write_one_output(tmp_path: Path) -> None:
    """A process has the directory until it ends, however it ends."""
    finished(tmp_path / "out.csv")
    code = (
        "import time; from vstatics.core.jobs.finished_pieces import FinishedPieces\n"
        f"FinishedPieces({str(tmp_path / 'out.csv')!r}).lock()\n"
        "print('held', flush=True); time.sleep(60)"
    )
    command = [sys.executable, "-c", code]
    with subprocess.Popen(command, stdout=subprocess.PIPE, env=environment()) as other:
        assert other.stdout is not None
        assert other.stdout.readline() == b"held\n"
        with pytest.raises(ReadError, match=rf"another sweep \(process {other.pid}\)"):
            store(tmp_path / "out.csv", resume=True)
        other.send_signal(signal.SIGKILL)
    assert store(tmp_path / "out.csv", resume=True).finished == 30


@contextlib.contextmanager
def small_disk(size: int) -> Iterator[None]:
    """A limit on the size of files is a small disk for this process."""
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, hard))
    try:
        with pytest.raises(OSError, match="File too large"):
            yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))


def test_a_piece_that_does_not_fit_on_the_disk_leaves_nothing(tmp_path: Path) -> None:
    written = store(tmp_path / "out.csv", out="ratio,efficiency,speeds,torques,lossy_torques")
    folder = Path(written.store.directory)
    before = names(folder)
    with small_disk(500):
        calculate(written)
    assert names(folder) == before
    calculate(written)
    with small_disk(5000):
        assemble(written)
    assert piece_file.ASSEMBLED not in names(folder)
    assemble(written)
    assert len((tmp_path / "out.csv").read_text("utf-8").splitlines()) == 31
