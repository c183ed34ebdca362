"""Who does the work: order, errors, processes that die."""

import itertools
import os
import signal
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from vstatics.core.errors import CaseError
from vstatics.core.jobs.alone import Workers
from vstatics.core.jobs.workers import workers

pytestmark = pytest.mark.slow
STATE = "the state"


def called(jobs: int, state: str = STATE) -> Workers:
    return workers(state, "item {}".format, jobs=jobs)


def doubled(state: str, item: int) -> tuple[str, int]:
    time.sleep(0.02 * (item % 3 == 0))  # so that they do not end in order
    return state, 2 * item


@pytest.mark.parametrize("jobs", [1, 2, 3])
def test_every_item_is_done_once_and_in_order_where_it_is_asked_for(jobs: int) -> None:
    with called(jobs) as made:
        done = list(made.each(doubled, range(20)))
        again = list(made.each(doubled, range(30), ordered=True))
    assert sorted(item for item, _ in done) == list(range(20))
    assert all(result == (STATE, 2 * item) for item, result in done)
    assert [item for item, _ in again] == list(range(30))


def together(folder: str, jobs: int) -> int:
    """The process that does it; none goes on before so many have come."""
    Path(folder, str(os.getpid())).touch()
    end = time.monotonic() + 50
    while len(list(Path(folder).iterdir())) < jobs:
        assert time.monotonic() < end, "the others never came"
        time.sleep(0.01)
    return os.getpid()


@pytest.mark.parametrize("jobs", [1, 2, 3])
def test_so_many_processes_work_at_once(jobs: int, tmp_path: Path) -> None:
    with called(jobs, str(tmp_path)) as made:
        seen = {process for _, process in made.each(together, [jobs] * 20)}
    assert len(seen) == jobs
    assert (os.getpid() in seen) == (jobs == 1)


@pytest.mark.parametrize("ordered", [True, False])
def test_only_a_few_items_are_under_way(ordered: bool) -> None:
    """However many there are: four for two processes, and the next one that is asked for."""
    asked = 0

    def items() -> Iterator[int]:
        nonlocal asked
        while asked < 1000:
            asked += 1
            yield asked

    with called(2) as made:
        for count, _ in enumerate(made.each(doubled, items(), ordered=ordered)):
            assert asked <= count + 5
            if count > 30:
                break


def wrong(_: str, item: int) -> int:
    if item == 3:
        raise ZeroDivisionError("divided")
    if item == 13:
        raise OSError(28, "No space left on device")
    if item == 23:
        raise CaseError("E090", "no such gear")
    return item


@pytest.mark.parametrize("jobs", [1, 2])
def test_an_error_names_the_item(jobs: int) -> None:
    own = r"^item 3: an error in vstatics, please report it: ZeroDivisionError: divided \[E002\]$"
    for kind, said, first in (
        (CaseError, own, 0),
        (OSError, "No space left on device", 10),
        (CaseError, r"^no such gear \[E090\]$", 20),
    ):
        with pytest.raises(kind, match=said), called(jobs) as made:
            list(made.each(wrong, range(first, first + 10)))


def dies_once(state: str, item: int) -> int:
    """Dies at item 5, but not a second time."""
    mark = Path(state, str(item))
    if item in (5, 11) and not mark.exists():
        mark.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return item


@pytest.mark.parametrize("ordered", [True, False])
def test_a_process_that_dies_is_replaced_and_nothing_is_lost(ordered: bool, tmp_path: Path) -> None:
    with called(2, str(tmp_path)) as made:
        done = [item for item, _ in made.each(dies_once, range(20), ordered=ordered)]
    assert sorted(done) == list(range(20))
    assert done == sorted(done) or not ordered


def dies(_: str, item: int) -> int:
    if item == 5:
        os.kill(os.getpid(), signal.SIGKILL)
    time.sleep(0.01)
    return item


def test_an_item_that_kills_every_process_is_given_up_by_its_name() -> None:
    with pytest.raises(CaseError, match=r"^item 5: the process died 3 times"), called(3) as made:
        list(made.each(dies, range(20)))


@pytest.mark.parametrize("stopped", [False, True], ids=["all is done", "nobody goes on"])
def test_processes_end_with_what_called_them(stopped: bool, tmp_path: Path) -> None:
    with called(2, str(tmp_path)) as made:
        results = made.each(together, [2] * 20)
        seen = {process for _, process in (itertools.islice(results, 1) if stopped else results)}
        if stopped:
            made.__exit__(KeyboardInterrupt)
    processes = {int(path.name) for path in tmp_path.iterdir()}
    assert len(processes) == 2
    assert seen <= processes
    assert not [process for process in processes if Path(f"/proc/{process}").exists()]


def test_a_caller_with_threads_does_not_fork() -> None:
    """A lock that another thread holds would stay locked in the forked process for ever."""
    done = threading.Event()
    other = threading.Thread(target=done.wait)
    other.start()
    try:
        with called(2) as made:
            assert len(list(made.each(doubled, range(4)))) == 4
    finally:
        done.set()
        other.join()


@pytest.mark.parametrize("jobs", [1, 2])
def test_results_that_nobody_took_do_not_come_later(jobs: int) -> None:
    with called(jobs) as made:
        assert len(list(itertools.islice(made.each(doubled, range(10)), 1))) == 1
        assert sorted(item for item, _ in made.each(doubled, range(20, 25))) == [*range(20, 25)]
