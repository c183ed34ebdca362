"""`vstatics synth box` as processes: several of them, killed ones, a Dask cluster."""

import json
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest

from tests.commands import environment, process
from tests.processes import names, wait_for
from tests.sweep.test_cluster import Cluster
from vstatics.synthesis.boxes.batches.found import found_in, prepare
from vstatics.synthesis.boxes.box import BoxSearch

pytestmark = [pytest.mark.slow, pytest.mark.alone]

SIMPSON = (
    *("--sets", 2, "--shift-elements", 4, "--engaged", 2, "--own-input"),
    *("--ratios", "2.45,1.45,1,-2.2", "-q", "-f", "json"),
)
GM = (
    *("--sets", 3, "--shift-elements", 5, "--engaged", 2),
    *("--ratios", "4.584,2.964,1.912,1.446,1,.746,-2.94", "-q"),
    *("--tolerance", 0.05),
)
"""Pieces of some seconds at most."""


@pytest.fixture(scope="module", autouse=True)
def _compiled() -> None:
    """The search is compiled before anything is killed; the machine code is kept."""
    prepare(BoxSearch(1, 2, 1, (3.0, 1.0)))


def begin(*arguments: object, cwd: Path) -> Any:
    """Start a search in a session of its own, which can be killed as a whole."""
    command = [sys.executable, "-m", "vstatics", "synth", "box", *map(str, arguments)]
    null = subprocess.DEVNULL
    return subprocess.Popen(
        command, cwd=cwd, env=environment(), stdout=null, stderr=null, start_new_session=True
    )


def test_a_search_that_is_killed_loses_no_piece(tmp_path: Path) -> None:
    """The result is that of one process, to the byte."""
    running = begin(*GM, "-j", 2, "-o", "found.json", cwd=tmp_path)
    parts = tmp_path / "found.json.parts"
    wait_for(lambda: parts.exists() and any(name.isdigit() for name in names(parts)))
    os.killpg(running.pid, signal.SIGKILL)
    running.wait()
    assert names(tmp_path) == ["found.json.parts"]
    again = process("synth", "box", *GM, "-o", "found.json", "--resume", "-j", 1, cwd=tmp_path)
    assert again[0] == 0
    assert process("synth", "box", *GM, "-o", "whole.json", "-j", 2, cwd=tmp_path)[0] == 0
    found, whole = ((tmp_path / name).read_bytes() for name in ("found.json", "whole.json"))
    assert found == whole
    assert json.loads(found)["found"] > 0
    assert names(tmp_path) == ["found.json", "whole.json"]


@pytest.fixture
def cluster(tmp_path: Path) -> Iterator[Cluster]:
    made = Cluster(tmp_path)
    made.workers.append(made.worker())
    yield made
    made.close()


def test_a_cluster_finds_the_same(cluster: Cluster) -> None:
    own = process("synth", "box", *SIMPSON, "-j", 1)
    asked = ("synth", "box", *SIMPSON, "--scheduler", cluster.address)
    assert process(*asked, cwd=cluster.folder) == own
    assert own[0] == 0


def test_threads_of_one_worker_do_not_disturb_each_other() -> None:
    search = BoxSearch(3, 5, 2, (4.584, 2.964, 1.912, 1.446, 1, 0.746, -2.94))
    pieces = range(4)
    alone = [found_in(search, piece, 40) for piece in pieces]
    with ThreadPoolExecutor(4) as pool:
        assert list(pool.map(lambda piece: found_in(search, piece, 40), pieces)) == alone
