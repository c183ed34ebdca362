"""A Dask cluster of processes on this machine; a worker is killed in the middle."""

import re
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import vstatics
from tests.commands import environment, json_file
from tests.processes import end, names, wait_for
from tests.sweep.sweeps import CASE_TEXT, begin, finished
from vstatics.core.extras import build
from vstatics.core.jobs import cluster as workers

pytestmark = [pytest.mark.slow, pytest.mark.alone]

SWEEP = ("box.yaml", "--vary", "D.ratio=-4:-2:1000", "--vary", "D.efficiency=.9:1:500")
"""Half a million variants in 8 pieces."""
LONG = ("box.yaml", "--vary", "D.ratio=-4:-2:10000", "--vary", "D.efficiency=.9:1:10000")
"""A hundred million variants, more than there is time for."""


def started(module: str, *arguments: object, cwd: Path, **variables: str) -> Any:
    command = [sys.executable, "-m", module, "--no-dashboard", *map(str, arguments)]
    null = subprocess.DEVNULL
    return subprocess.Popen(
        command, cwd=cwd, env=environment(**variables), stdout=null, stderr=null
    )


class Cluster:
    """A scheduler and two workers, each a process."""

    def __init__(self, folder: Path) -> None:
        """Start them."""
        (folder / "box.yaml").write_text(CASE_TEXT, "utf-8")
        self.folder = folder
        file = folder / "scheduler.json"
        options = ("--host", "127.0.0.1", "--port", 0, "--scheduler-file", file)
        self.scheduler = started("distributed.cli.dask_scheduler", *options, cwd=folder)
        wait_for(lambda: file.exists() and file.read_text("utf-8").endswith("}"))
        self.address = json_file(file)["address"]
        self.workers = [self.worker() for _ in range(2)]

    def worker(self, **variables: str) -> Any:
        """Start one more worker."""
        more = (self.address, "--nthreads", 1, "--no-nanny", "--local-directory", self.folder / "w")
        return started("distributed.cli.dask_worker", *more, cwd=self.folder, **variables)

    def close(self) -> None:
        """End all of them."""
        for process in (*self.workers, self.scheduler):
            process.kill()
            process.wait()

    def begin(self, *arguments: object) -> Any:
        """Start a sweep on the cluster."""
        return begin(*arguments, "--scheduler", self.address, cwd=self.folder)


@pytest.fixture(autouse=True)
def _distributed() -> None:
    """Import `distributed` only for tests of a cluster, because this takes half a second."""
    pytest.importorskip("distributed")


@pytest.fixture
def cluster(tmp_path: Path) -> Iterator[Cluster]:
    made = Cluster(tmp_path)
    yield made
    made.close()


def test_a_worker_that_is_killed_loses_nothing(cluster: Cluster) -> None:
    """What it was at goes to the other; the file is that of one process, to the byte."""
    folder = cluster.folder
    assert end(begin(*SWEEP, "-o", "one.csv", cwd=folder))[0] == 0
    running = cluster.begin(*SWEEP, "-o", "out.csv")
    wait_for(lambda: len(finished(folder / "out.csv.parts")) >= 2)
    cluster.workers[0].kill()
    status, said = end(running)
    assert (status, "500000 rows of 500000 variants" in said) == (0, True)
    assert (folder / "out.csv").read_bytes() == (folder / "one.csv").read_bytes()


def test_a_table_and_the_best_come_from_a_cluster(cluster: Cluster) -> None:
    """The workers do not see the file of the table."""
    folder = cluster.folder
    assert end(begin(*SWEEP, "--out", "ratio[low]", "-o", "one.csv", cwd=folder))[0] == 0
    lines = (folder / "one.csv").read_text("utf-8").splitlines()
    table = "\n".join(",".join(line.split(",")[1:3]) for line in lines)
    (folder / "own.csv").write_text(table, "utf-8")
    options = ("box.yaml", "--variants", "own.csv", "--max", "efficiency[low]", "--best", 5)
    assert end(cluster.begin(*options, "-o", "two.csv"))[0] == 0
    assert end(begin(*options, "-o", "three.csv", cwd=folder))[0] == 0
    assert (folder / "two.csv").read_bytes() == (folder / "three.csv").read_bytes()
    assert end(cluster.begin(*SWEEP, "--out", "ratio[low]", "-o", "four.csv"))[0] == 0
    assert (folder / "four.csv").read_bytes() == (folder / "one.csv").read_bytes()


@pytest.mark.parametrize(
    ("lost", "words"),
    [
        ("scheduler", "the connection to the scheduler is lost"),
        ("workers", "all workers are lost, or all that were there in the beginning"),
    ],
)
def test_a_loss_is_shown_in_a_line(lost: str, words: str, cluster: Cluster) -> None:
    folder = cluster.folder
    running = cluster.begin(*SWEEP, "-o", "out.csv")
    wait_for(lambda: finished(folder / "out.csv.parts"))
    for process in [cluster.scheduler] if lost == "scheduler" else cluster.workers:
        process.kill()
    status, said = end(running)
    first, second = said.splitlines()
    assert (status, first) == (1, f"{cluster.address}: error: {words}")
    assert second.endswith("the same command with --resume goes on")


def other_build(folder: Path) -> dict[str, str]:
    """Where a copy of the package is found that calculates the same, as another build."""
    package = Path(vstatics.__file__).parent
    shutil.copytree(package, folder / "other" / "vstatics", ignore=lambda *_: ["__pycache__"])
    with (folder / "other/vstatics/__main__.py").open("a", encoding="utf-8") as file:
        file.write("# another\n")
    return {"PYTHONPATH": str(folder / "other")}


@pytest.mark.parametrize("late", [False, True])
def test_a_worker_with_another_build_is_refused_also_when_it_joins_late(
    late: bool, cluster: Cluster
) -> None:
    folder = cluster.folder
    variables = other_build(folder)
    if not late:
        cluster.workers.append(cluster.worker(**variables))
        time.sleep(5)
    running = cluster.begin(*LONG, "-o", "out.csv")
    if late:
        wait_for(lambda: finished(folder / "out.csv.parts"))
        cluster.workers.append(cluster.worker(**variables))
    status, said = end(running)
    first = next(line for line in said.splitlines() if "error" in line)  # progress may be told
    expected = rf"expected \S+ \(build {build()}\)"
    assert status == 1
    assert re.search(rf"error: worker \S+ has vstatics \S+ \(build \w+\), {expected}", first)


def test_who_was_lost_is_asked_where_dask_does_not_know_it_yet(cluster: Cluster) -> None:
    """The client has not seen the end of its connection; losing workers ends none.

    After a loss Dask connects again, but what was under way is cancelled.
    """
    cancelled = Exception("cancelled")
    cancelled.reason = "scheduler-connection-lost"  # type: ignore[attr-defined]
    with workers.Cluster("state", str, cluster.address) as made:
        assert "all workers are lost" in str(made._loss(OSError()))
        assert "the connection to the scheduler is lost" in str(made._loss(cancelled))
        cluster.scheduler.kill()
        assert "the connection to the scheduler is lost" in str(made._loss(OSError()))


@pytest.mark.parametrize(
    ("address", "words"),
    [
        ("tcp://127.0.0.1:1", "no Dask scheduler answers there"),
        ("nonsense://x", "is not the address of a scheduler, expected tcp://HOST:PORT"),
    ],
)
def test_a_missing_scheduler_is_reported(address: str, words: str, tmp_path: Path) -> None:
    (tmp_path / "box.yaml").write_text(CASE_TEXT, "utf-8")
    sweep = ("box.yaml", "--vary", "D.ratio=-4:-2:1000", "-o", "o.csv", "--scheduler", address)
    status, said = end(begin(*sweep, cwd=tmp_path))
    assert (status, said.startswith(f"{address}: error: {words}")) == (1, True)
    assert len(said.splitlines()) <= 2
    assert names(tmp_path) == ["box.yaml"]
