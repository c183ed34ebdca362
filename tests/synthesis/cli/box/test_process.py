"""`vstatics synth box` as processes: a Dask cluster, and threads of one worker."""

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from tests.commands import process
from tests.sweep.test_cluster import Cluster
from vstatics.synthesis.boxes.batches.found import found_in, prepare
from vstatics.synthesis.boxes.box import BoxSearch

pytestmark = [pytest.mark.slow, pytest.mark.alone]

SIMPSON = (
    *("--sets", 2, "--shift-elements", 4, "--engaged", 2, "--own-input"),
    *("--ratios", "2.45,1.45,1,-2.2", "-q", "-f", "json"),
)


@pytest.fixture(scope="module", autouse=True)
def _compiled() -> None:
    """The search is compiled before it is called; the machine code is kept."""
    prepare(BoxSearch(1, 2, 1, (3.0, 1.0)))


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
