"""A sweep as a process that is interrupted; tests/core/cli kill it and take its disk."""

import os
import shutil
import signal
from pathlib import Path

import pytest

from tests.processes import end, names, wait_for
from tests.sweep.sweeps import CASE_TEXT, begin, finished

pytestmark = [pytest.mark.slow, pytest.mark.alone]

SWEEP = ("box.yaml", "--vary", "D.ratio=-4:-2:1000", "--vary", "D.efficiency=.9:1:1000")
"""A million variants in 16 pieces, the last of them small."""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "box.yaml").write_text(CASE_TEXT, "utf-8")
    return tmp_path


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    folder = tmp_path_factory.mktemp("whole")
    (folder / "box.yaml").write_text(CASE_TEXT, "utf-8")
    assert end(begin(*SWEEP, "-o", "out.csv", "-j", 2, cwd=folder))[0] == 0
    return (folder / "out.csv").read_bytes()


@pytest.mark.parametrize("jobs", [1, 2])
@pytest.mark.parametrize(
    ("number", "expected"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)], ids=["int", "term"]
)
def test_an_interrupted_sweep_says_where_it_stopped_and_goes_on(
    jobs: int, number: signal.Signals, expected: int, folder: Path, whole: bytes
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
    status, said = end(begin(*SWEEP, "-o", "out.csv", "-j", 2, "--resume", cwd=folder))
    assert status == 0
    assert f", {65536 * kept} of them before;" in said
    assert (folder / "out.csv").read_bytes() == whole
    assert names(folder) == ["box.yaml", "out.csv"]


def most_memory(process: int) -> int:
    text = Path(f"/proc/{process}/status").read_text("utf-8")
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
