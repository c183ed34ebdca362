"""A sweep as a process that is killed, interrupted, or runs out of disk: nothing is lost."""

from __future__ import annotations

import contextlib
import os
import resource
import shutil
import signal
from pathlib import Path

import pytest

from tests.processes import children, end, names, wait_for
from tests.sweep.sweeps import CASE_TEXT, begin, finished

pytestmark = [pytest.mark.slow, pytest.mark.alone]

SWEEP = ("box.yaml", "--vary", "D.ratio=-4:-2:1000", "--vary", "D.efficiency=.9:1:1000")
"""A million variants in 16 pieces, the last of them small."""
PIECES = 16


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "box.yaml").write_text(CASE_TEXT, encoding="utf-8")
    return tmp_path


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    """The outputs of undisturbed sweeps."""
    folder = tmp_path_factory.mktemp("whole")
    (folder / "box.yaml").write_text(CASE_TEXT, encoding="utf-8")
    for form in ("csv", "npz"):
        assert end(begin(*SWEEP, "-o", f"out.{form}", "-j", 2, cwd=folder))[0] == 0
    return {form: (folder / f"out.{form}").read_bytes() for form in ("csv", "npz")}


def resumed(folder: Path, whole: bytes, output: str = "out.csv", jobs: int = 2) -> str:
    """Go on, and compare with an undisturbed output; what is said."""
    status, said = end(begin(*SWEEP, "-o", output, "-j", jobs, "--resume", cwd=folder))
    assert status == 0
    assert (folder / output).read_bytes() == whole
    assert names(folder) == ["box.yaml", output]
    return said


@pytest.mark.parametrize("form", ["csv", "npz"])
@pytest.mark.parametrize("jobs", [1, 2])
def test_a_killed_sweep_goes_on(
    form: str, jobs: int, folder: Path, whole: dict[str, bytes]
) -> None:
    """The whole process group is killed, twice, in the middle; the bytes are the same."""
    output = f"out.{form}"
    parts = folder / f"{output}.parts"
    for pieces in (3, 8):
        running = begin(*SWEEP, "-o", output, "-j", jobs, "--resume", cwd=folder)
        wait_for(lambda: len(finished(parts)) >= pieces)  # noqa: B023
        os.killpg(running.pid, signal.SIGKILL)
        assert end(running)[0] == -signal.SIGKILL
    assert not (folder / output).exists()
    kept = len(finished(parts))
    assert 8 <= kept < PIECES
    status, said = end(begin(*SWEEP, "-o", output, cwd=folder))
    assert status == 1
    assert f"holds {kept} of {PIECES} finished pieces of this sweep" in said
    assert "of them before" in resumed(folder, whole[form], output, 3 - jobs)


def test_a_sweep_that_lost_its_parent_ends(folder: Path, whole: dict[str, bytes]) -> None:
    """Only the parent is killed: its workers end by themselves, and hold nothing."""
    running = begin(*SWEEP, "-o", "out.csv", "-j", 2, cwd=folder)
    wait_for(lambda: len(finished(folder / "out.csv.parts")) >= 2)
    workers = children(running.pid)
    os.kill(running.pid, signal.SIGSTOP)
    status, said = end(begin(*SWEEP, "-o", "out.csv", "--resume", cwd=folder))
    assert (status, f"another sweep (process {running.pid}) is writing" in said) == (1, True)
    running.kill()
    running.wait()
    assert len(workers) == 2
    wait_for(lambda: not any(_runs(worker) for worker in workers), 5)
    running.stderr.close()
    resumed(folder, whole["csv"])


def _runs(process: int) -> bool:
    with contextlib.suppress(OSError):
        text = Path(f"/proc/{process}/stat").read_text(encoding="utf-8")
        return text.rpartition(")")[2].split()[0] != "Z"  # nobody may have waited for it
    return False


def test_a_worker_that_is_killed_is_replaced(folder: Path, whole: dict[str, bytes]) -> None:
    running = begin(*SWEEP, "-o", "out.csv", "-j", 2, cwd=folder)
    for pieces in (2, 5):
        wait_for(lambda: len(finished(folder / "out.csv.parts")) >= pieces)  # noqa: B023
        os.kill(children(running.pid)[0], signal.SIGKILL)
    status, said = end(running)
    assert (status, "1000000 rows of 1000000 variants" in said) == (0, True)
    assert (folder / "out.csv").read_bytes() == whole["csv"]


@pytest.mark.parametrize("jobs", [1, 2])
@pytest.mark.parametrize(
    ("number", "expected"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)], ids=["int", "term"]
)
def test_an_interrupted_sweep_says_where_it_stopped(
    jobs: int, number: signal.Signals, expected: int, folder: Path, whole: dict[str, bytes]
) -> None:
    """Ctrl-C goes to the whole group, as a terminal sends it; SIGTERM to the process."""
    running = begin(*SWEEP, "-o", "out.csv", "-j", jobs, cwd=folder)
    wait_for(lambda: len(finished(folder / "out.csv.parts")) >= 1)
    (os.killpg if number == signal.SIGINT else os.kill)(running.pid, number)
    status, said = end(running)
    kept = len(finished(folder / "out.csv.parts"))
    assert status == expected
    assert said == (
        f"stopped; {65536 * kept} of 1000000 variants are finished and kept in out.csv.parts; "
        "the same command with --resume goes on\n"
    )
    assert f", {65536 * kept} of them before;" in resumed(folder, whole["csv"])


@pytest.mark.parametrize("jobs", [1, 2])
@pytest.mark.parametrize("megabytes", [1, 10])
def test_a_full_disk_loses_nothing(
    jobs: int, megabytes: int, folder: Path, whole: dict[str, bytes]
) -> None:
    """No piece fits into 1 MB; into 10 MB each does, but not the whole output."""
    limit = megabytes * 10**6

    def small() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

    status, said = end(begin(*SWEEP, "-o", "out.csv", "-j", jobs, cwd=folder, before=small))
    kept = "1000000 of 1000000 variants are finished and kept in out.csv.parts"
    assert status == 1
    assert said.splitlines()[0] == "out.csv: error: cannot be written: File too large"
    assert ("nothing was finished" if megabytes == 1 else kept) in said
    assert len(said.splitlines()) == 2
    assert bool(finished(folder / "out.csv.parts")) == (megabytes > 1)
    resumed(folder, whole["csv"], jobs=jobs)


def most_memory(process: int) -> int:
    """The most memory that a process has had so far [kB]."""
    text = Path(f"/proc/{process}/status").read_text(encoding="utf-8")
    return next(int(line.split()[1]) for line in text.splitlines() if line.startswith("VmHWM"))


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="looks into /proc")
def test_a_million_million_variants_start_in_the_memory_of_a_million(folder: Path) -> None:
    """Their pieces are made as they are needed; a list of them took 600 MB."""
    memory = []
    for count in (1000, 1_000_000):
        grid = ("--vary", f"D.ratio=-4:-2:{count}", "--vary", f"D.efficiency=.9:1:{count}")
        where = ("--where", "ratio[low] > 0")  # else there is no room on the disk
        running = begin("box.yaml", *grid, *where, "-o", "out.npz", cwd=folder)
        wait_for(lambda: len(finished(folder / "out.npz.parts")) >= 3)
        memory.append(most_memory(running.pid))
        os.killpg(running.pid, signal.SIGKILL)
        end(running)
        shutil.rmtree(folder / "out.npz.parts")
    assert memory[1] < memory[0] + 10_000
