"""Processes that share the work on many items; what they bring comes in order.

Each worker has a line of its own, so that it is known at which item one died: that item
is tried once more by a new worker, and then given up. The others lose nothing.
"""

from __future__ import annotations

import os
import signal
import sys
import threading
import warnings
from collections import Counter, deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from vstatics.errors import Problem, ReadError

if TYPE_CHECKING:
    from multiprocessing.connection import Connection

Item = TypeVar("Item")
Result = TypeVar("Result")

QUEUED = 2
"""So many items a worker has, so that it need not wait for the next."""
AHEAD = 64
"""So many results for each worker may wait for one that takes long."""
TRIES = 2
"""An item at which so many workers died is given up."""
PATIENCE = 5
"""So long a worker may take to end when it is told to. [s]"""


class Crew(Generic[Item, Result]):
    """Several processes that work on items, as long as the context lasts.

    Parameters
    ----------
    function : callable
        What is done with an item; it can be pickled, and catches its exceptions.
    lost : callable
        The result of an item that is given up.
    jobs : int
        Number of processes.
    died : callable, optional
        Is told the id of a process that died, or was ended while it may have been at work.
    """

    def __init__(
        self,
        function: Callable[[Item], Result],
        lost: Callable[[Item], Result],
        jobs: int,
        died: Callable[[int], None] = lambda process: None,  # noqa: ARG005
    ) -> None:
        """Nothing is started before there is something to do."""
        self.function, self.lost, self.jobs, self.died = function, lost, jobs, died
        self.workers: list[_Worker] = []
        self.deaths: Counter[int] = Counter()

    def __enter__(self) -> Crew[Item, Result]:
        """Nothing is to be done yet."""
        return self

    def __exit__(self, *error: object) -> None:
        """Send the workers home; at once if there was an error."""
        at_once = error[0] is not None
        for worker in self.workers:
            worker.dismiss(at_once=at_once)
        for worker in self.workers:
            worker.join()
            if at_once:
                self.died(worker.process.pid or 0)
        self.workers.clear()

    def each(
        self,
        items: Iterable[Item],
        *,
        here: Callable[[Item], bool] = lambda item: False,  # noqa: ARG005
    ) -> Iterator[Result]:
        """The result of every item, in the order of the items.

        Parameters
        ----------
        here : callable
            Whether only this process can do an item.

        Raises
        ------
        ReadError
            If no process can be started.
        """
        coming = _Coming(items)
        done: dict[int, Result] = {}
        turn = 0
        while True:
            self._give(coming, done, here)
            if turn not in done:
                if not any(worker.items for worker in self.workers):
                    return
                self._gather(coming, done)
            while turn in done:
                yield done.pop(turn)
                turn += 1

    def _give(self, coming: _Coming, done: dict[int, Result], here: Callable[[Item], bool]) -> None:
        """Give items to the workers, as many as may be under way."""
        under_way = sum(len(worker.items) for worker in self.workers)
        while under_way + len(done) < AHEAD * self.jobs:
            worker = self._free()
            entry = coming.next() if worker else None
            if worker is None or entry is None:
                return
            number, item = entry
            if here(item):
                done[number] = self.function(item)
            else:
                worker.give(number, item)
                under_way += 1

    def _free(self) -> _Worker | None:
        """The worker with the least to do, if it has not enough."""
        if len(self.workers) < self.jobs:
            try:
                self.workers.append(_Worker(self.function, self.workers))
            except OSError as error:
                message = f"processes (--jobs) can't be started: {error.strerror or error}"
                raise ReadError([Problem(message)]) from None
        least = min(self.workers, key=lambda worker: len(worker.items))
        return least if len(least.items) < QUEUED else None

    def _gather(self, coming: _Coming, done: dict[int, Result]) -> None:
        """Wait for results; what a worker that died was at is tried again."""
        from multiprocessing.connection import wait

        ready = set(wait([worker.connection for worker in self.workers]))
        for worker in [one for one in self.workers if one.connection in ready]:
            try:
                number, result = worker.connection.recv()
            except (EOFError, OSError):
                self._replace(worker, coming, done)
            else:
                del worker.items[number]
                done[number] = result

    def _replace(self, worker: _Worker, coming: _Coming, done: dict[int, Result]) -> None:
        self.workers.remove(worker)
        worker.dismiss(at_once=True)
        worker.join()
        self.died(worker.process.pid or 0)
        entries = list(worker.items.items())
        if entries:
            number, item = entries[0]  # the one that it was at
            self.deaths[number] += 1
            if self.deaths[number] >= TRIES:
                done[number] = self.lost(item)
                del entries[0]
        coming.back(entries)


class _Coming:
    """The items to come with their numbers, those first that are to be tried again."""

    def __init__(self, items: Iterable[Any]) -> None:
        self.items = enumerate(items)
        self.again: deque[tuple[int, Any]] = deque()

    def next(self) -> tuple[int, Any] | None:
        return self.again.popleft() if self.again else next(self.items, None)

    def back(self, entries: Iterable[tuple[int, Any]]) -> None:
        self.again = deque(sorted([*self.again, *entries], key=lambda entry: entry[0]))


class _Worker:
    """A process, the line to it, and what it has still to do."""

    def __init__(self, function: Callable[[Any], Any], others: Iterable[_Worker]) -> None:
        import multiprocessing

        # A fork costs nothing, but is not safe where another thread holds a lock.
        fork = sys.platform == "linux" and threading.active_count() == 1
        context: Any = multiprocessing.get_context("fork" if fork else "spawn")
        self.items: dict[int, Any] = {}
        self.connection, far = context.Pipe()
        inherited = [worker.connection for worker in others] + [self.connection] if fork else []
        self.process = context.Process(target=_serve, args=(function, far, inherited), daemon=True)
        with _later(signal.SIGINT, signal.SIGTERM), warnings.catch_warnings():
            # Python counts the threads of BLAS, which can stand it.
            warnings.simplefilter("ignore", DeprecationWarning)
            self.process.start()
        far.close()

    def give(self, number: int, item: Any) -> None:
        self.items[number] = item
        with suppress(OSError):  # it died: that is seen when its results are read
            self.connection.send((number, item))

    def dismiss(self, *, at_once: bool) -> None:
        self.connection.close()
        if at_once:
            self.process.terminate()

    def join(self) -> None:
        self.process.join(PATIENCE)
        if self.process.is_alive():
            self.process.kill()
            self.process.join()


@contextmanager
def _later(*signals: signal.Signals) -> Iterator[None]:
    """Let signals wait; a process that is started meanwhile begins so, too."""
    before = signal.pthread_sigmask(signal.SIG_BLOCK, signals)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _serve(
    function: Callable[[Any], Any], connection: Connection, inherited: Iterable[Connection]
) -> None:
    """Do what a worker does, until its line ends; Ctrl-C is left to the parent."""
    for other in inherited:
        other.close()
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGINT, signal.SIGTERM])
    with suppress(EOFError, OSError):  # the parent has ended
        while True:
            number, item = connection.recv()
            connection.send((number, function(item)))
    os._exit(0)
