"""Runs that are stopped: by Ctrl-C, SIGTERM, a dead worker, a full disk; and the bar they show.

A case that is a pipe waits for this test, so that everything happens at a known moment.
"""

import contextlib
import json
import os
import re
import signal
import subprocess
import time
from pathlib import Path

import pytest

from tests.commands import BAD, MZKT, on_terminal, process
from tests.processes import children, names, running, wait_for
from vstatics.core.cli.shared import progress

pytestmark = pytest.mark.slow
CASES = ("a.dat", "b.dat", "pipe.dat", "c.dat", "d.dat")


@pytest.fixture(autouse=True)
def _files(folder: Path) -> None:
    """Cases of which the third is a pipe."""
    for name in CASES:
        (folder / name).write_bytes(MZKT.read_bytes())
    (folder / "pipe.dat").unlink()
    os.mkfifo("pipe.dat")


def ended(run: subprocess.Popen[bytes]) -> tuple[int, list[str]]:
    """The exit status, and the lines of stderr but those of progress, which slow runs have."""
    _, err = run.communicate(timeout=60)
    lines = err.decode().splitlines()
    return run.returncode, [line for line in lines if not line.startswith("cases: ")]


def opened_for_reading() -> int:
    """Wait until the run reads the pipe."""
    return os.open("pipe.dat", os.O_WRONLY)


def stopped_at_pipe(
    sent: signal.Signals, *arguments: str, jobs: int = 1
) -> tuple[int, list[str], list[int]]:
    """Send a signal to a run that waits at the pipe: its end, and its workers."""
    with running("run", *arguments, "--jobs", str(jobs)) as run:
        pipe = opened_for_reading()
        found = children(run.pid)
        run.send_signal(sent)
        told = ended(run)
        os.close(pipe)
    return *told, found


def called(*arguments: str) -> tuple[int, bytes, bytes]:
    return process("run", *arguments, cwd=Path.cwd())


def reader(run: subprocess.Popen[bytes]) -> int:
    """The worker that reads the pipe; its end appears a moment after it was opened."""
    pipe = Path("pipe.dat").absolute()

    def reading() -> list[int]:
        found = []
        for worker in children(run.pid):
            with contextlib.suppress(OSError):
                handles = [one.readlink() for one in Path(f"/proc/{worker}/fd").iterdir()]
                found += [worker] * (pipe in handles)
        return found

    wait_for(reading)
    return reading()[0]


def is_alive(process_id: int) -> bool:
    """Whether a thread of a process runs; one that nobody has waited for yet does not."""
    try:
        state = Path(f"/proc/{process_id}/stat").read_text("utf-8")
        threads = len(list(Path(f"/proc/{process_id}/task").iterdir()))
    except OSError:
        return False
    return threads > 1 or state.rpartition(")")[2].split()[0] != "Z"


def written(folder: str = "out") -> list[str]:
    """What is in a folder, the record aside."""
    return [name for name in names(Path(folder)) if name != ".vstatics-run-json"]


TO_DIRECTORY = (*CASES, "-f", "json", "-o", "out")
KEPT = "results are in out; the same command with --resume goes on"


SIGNALS = pytest.mark.parametrize(
    ("sent", "status"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)], ids=["INT", "TERM"]
)


@SIGNALS
def test_a_signal_leaves_what_is_finished(sent: signal.Signals, status: int) -> None:
    told = stopped_at_pipe(sent, *TO_DIRECTORY)
    assert told[:2] == (status, [f"stopped after 2 of 5 cases; {KEPT}"])
    assert written() == ["a.json", "b.json"]
    Path("pipe.dat").unlink()
    Path("pipe.dat").write_bytes(MZKT.read_bytes())
    again = called(*TO_DIRECTORY, "--resume")
    assert again == (0, b"", b"5 of 5 cases calculated (2 of them before)\n")
    assert called(*TO_DIRECTORY)[0] == 0


@SIGNALS
def test_a_signal_ends_the_workers_too(sent: signal.Signals, status: int) -> None:
    """Cases behind the one that waits may be finished too; they were not told of yet."""
    ended_with, lines, found = stopped_at_pipe(sent, *TO_DIRECTORY, jobs=2)
    assert (ended_with, len(found)) == (status, 2)
    assert re.fullmatch(f"stopped after [012] of 5 cases; {KEPT}", "".join(lines))
    assert set(written()) <= {"a.json", "b.json", "c.json", "d.json"}
    assert not any(map(is_alive, found))


def test_a_stream_of_lines_is_whole_lines_and_a_file_is_not_there() -> None:
    with running("run", *CASES, "-f", "jsonl") as run:
        pipe = opened_for_reading()
        run.send_signal(signal.SIGINT)
        out, err = run.communicate(timeout=60)
        os.close(pipe)
    assert len([json.loads(line) for line in out.splitlines()]) == 2
    assert err == b"stopped after 2 of 5 cases; the output ends there\n"
    told = stopped_at_pipe(signal.SIGTERM, *CASES, "-f", "jsonl", "-o", "all.jsonl")
    kept = "all.jsonl was not written; the same command with --resume goes on"
    assert told[:2] == (143, [f"stopped after 2 of 5 cases; {kept}"])
    assert written(".") == sorted([*CASES, "all.jsonl.parts"])


def kill_the_reader(run: subprocess.Popen[bytes]) -> None:
    """Kill the worker that reads the pipe, and close it before another can open it."""
    pipe = opened_for_reading()
    worker = reader(run)
    run.send_signal(signal.SIGSTOP)
    os.kill(worker, signal.SIGKILL)
    wait_for(lambda: not is_alive(worker))
    os.close(pipe)
    run.send_signal(signal.SIGCONT)


def test_a_case_at_which_two_workers_die_fails_and_the_others_go_on() -> None:
    with running("run", *TO_DIRECTORY, "--jobs", "2") as run:
        kill_the_reader(run)
        kill_the_reader(run)
        status, lines = ended(run)
    assert status == 1
    assert lines[0].startswith("pipe.dat: error: the process that calculated it died twice")
    assert lines[1:] == ["4 of 5 cases calculated, 1 failed:", f"  {lines[0]}"]
    assert written() == ["a.json", "b.json", "c.json", "d.json"]


def test_workers_do_not_outlive_the_run() -> None:
    with running("run", *TO_DIRECTORY, "--jobs", "2") as run:
        pipe = opened_for_reading()
        found = children(run.pid)
        run.kill()
        run.wait()
        assert len(found) == 2
        wait_for(lambda: not any(map(is_alive, found)))  # also the one that waits for its case
        os.close(pipe)


def plain(shown: str) -> str:
    """What stands on a terminal in the end, roughly: without the codes that draw."""
    return re.sub(r"\x1b\[[0-9;?]*[A-Za-z]", "", shown)


@pytest.mark.parametrize("variables", [{}, {"NO_COLOR": "1"}], ids=["colour", "NO_COLOR"])
def test_a_bar_on_a_terminal_leaves_messages_whole(variables: dict[str, str]) -> None:
    Path("bad.yaml").write_text(BAD, "utf-8")
    given = ("run", "a.dat", "bad.yaml", "b.dat", "-f", "json", "-o", "out")
    shown = on_terminal(*given, cwd=Path.cwd(), **variables)
    messages = called(*given[1:])[2].decode()
    assert re.search("0/3.* cases", shown)
    assert ("\x1b[3" in shown) == (not variables)  # a colour
    for line in messages.splitlines():
        assert line in plain(shown)
    assert plain(shown).endswith(messages[messages.index("2 of 3 cases") :])


def test_there_is_no_bar_between_results_on_a_terminal_nor_on_one_that_cannot() -> None:
    shown = on_terminal("run", "a.dat", "b.dat", cwd=Path.cwd())
    assert shown == called("a.dat", "b.dat")[1].decode()
    shown = on_terminal("run", "a.dat", "b.dat", "-o", "out", cwd=Path.cwd(), terminal="dumb")
    assert shown == "2 of 2 cases calculated\n"


def test_a_bar_tells_rate_and_time_left(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(progress, "PERIOD", 0.0)
    monkeypatch.setattr(progress, "_is_terminal", lambda _: True)
    monkeypatch.delenv("TERM", raising=False)
    monkeypatch.setenv("COLUMNS", "80")
    monkeypatch.setenv("TTY_COMPATIBLE", "1")
    monkeypatch.setenv("FORCE_COLOR", "1")
    with progress.progress(10_000_000, "combinations") as advance:
        for _ in range(10):
            time.sleep(0.002)
            advance(500_000)
    shown = re.sub(r"\x1b\[[0-9;?]*[a-zA-Z]", "\n", capsys.readouterr().err)
    assert re.search(r"5000000/10000000\s+combinations.*/s.*0:00:0", shown.replace("\n", ""))
    assert max(map(len, shown.splitlines())) <= 80


def test_two_runs_do_not_write_one_directory() -> None:
    """Neither another one, nor one that would go on; other formats have a run of their own."""
    with running("run", *TO_DIRECTORY) as run:
        pipe = opened_for_reading()
        for more in (("--coast",), ("--resume",)):
            said = called("a.dat", "b.dat", *TO_DIRECTORY[5:], *more)
            message = f"out: error: another run (process {run.pid}) is writing this output [E034]\n"
            assert said == (1, b"", message.encode())
        assert called("a.dat", "-f", "csv", "-o", "out/")[0] == 0
        os.write(pipe, MZKT.read_bytes())
        os.close(pipe)
        assert ended(run) == (0, ["5 of 5 cases calculated"])
    assert not list(Path("out").glob(".*.lock"))
    assert called("a.dat", *TO_DIRECTORY[5:], "--coast")[0] == 0


def test_what_a_killed_run_was_writing_is_removed_by_the_next() -> None:
    """Not what a run into another format writes, or into a file of its own."""
    Path("out").mkdir()
    own = [".vstatics-7-0", ".vstatics-csv-7-0", ".vstatics-of-mine"]
    for name in (".vstatics-json-7-0", ".vstatics-json-7-1", *own):
        Path("out", name).touch()
    assert called("a.dat", "-f", "json", "-o", "out/")[0] == 0
    assert written() == sorted([*own, "a.json"])
