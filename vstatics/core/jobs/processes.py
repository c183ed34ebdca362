"""Several processes on this machine, which are replaced when they die.

Each process has its own pipe, so the item at which a process dies is known. A new process tries
this item again. After several deaths the item is abandoned. Other items are not affected.
"""

from __future__ import annotations

import os
import signal
import sys
import threading
import warnings
from collections import Counter, deque
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any

from vstatics.core.errors import CaseError, ReadError
from vstatics.core.jobs.alone import Describe, Item, Result, Rules, Work, Workers, call

if TYPE_CHECKING:
    from multiprocessing.connection import Connection

QUEUED = 2
"""Number of items that each process has in its queue, so that it never waits for items."""
END_SECONDS = 5
"""Time that a process has to end after its pipe is closed; it is then killed. [s]"""
TELLING = "telling"
"""Name of the thread that prints progress, which holds locks only while printing."""


class Processes(Workers):
    """Several processes on the local machine; see `vstatics.core.jobs.alone.Workers`."""

    def __init__(self, state: object, describe: Describe, jobs: int, rules: Rules) -> None:
        super().__init__(state, describe)
        self.jobs, self.rules = jobs, rules
        self._processes: list[_Process] = []

    def __exit__(self, *error: object) -> None:
        """End the processes. After an error, items in progress are abandoned."""
        self._end(list(self._processes), at_once=error[0] is not None)

    def each(
        self, function: Work[Item, Result], items: Iterable[Item], *, ordered: bool = False
    ) -> Iterator[tuple[Item, Result]]:
        """Process the items; see `vstatics.core.jobs.alone.Workers`.

        Raises
        ------
        ReadError
            If processes cannot be started.
        """
        coming = _Coming(items)
        done: dict[int, tuple[Item, Result]] = {}
        turn = 0
        try:
            while True:
                self._give(function, coming, done)
                if done and (not ordered or turn in done):
                    yield done.pop(turn if ordered else next(iter(done)))
                    turn += 1
                elif self._under_way():
                    self._gather(coming, done)
                else:
                    return
        finally:
            self._end([process for process in self._processes if process.items], at_once=True)

    def _under_way(self) -> int:
        return sum(len(process.items) for process in self._processes)

    def _give(self, function: Work[Any, Any], coming: _Coming, done: dict[int, Any]) -> None:
        """Send items to processes, within the limits `QUEUED` and `Rules.ahead`."""
        under_way = self._under_way()
        while under_way + len(done) < self.rules.ahead * self.jobs:
            if under_way >= QUEUED * self.jobs:
                return
            entry = coming.next()
            if entry is None:
                return
            number, item = entry
            if self.rules.here(item):
                done[number] = item, call(function, self.state, item, self.describe)
            else:
                self._free().give(number, item, function)
                under_way += 1

    def _free(self) -> _Process:
        if len(self._processes) < self.jobs:
            try:
                process = _Process(self.state, self.describe, self._processes)
            except OSError as error:
                message = f"processes (--jobs) cannot be started: {error.strerror or error}"
                raise ReadError("E035", message) from None
            self._processes.append(process)
            return process
        return min(self._processes, key=lambda process: len(process.items))

    def _gather(self, coming: _Coming, done: dict[int, Any]) -> None:
        """Wait for results, and return the items of dead processes to the queue."""
        from multiprocessing.connection import wait

        ready = set(wait([process.connection for process in self._processes]))
        for process in [
            candidate for candidate in self._processes if candidate.connection in ready
        ]:
            try:
                number, result, error = process.connection.recv()
            except (EOFError, OSError):
                self._end([process], at_once=True)
                self._again(list(process.items.items()), coming, done)
                continue
            if error is not None:
                raise error
            done[number] = process.items.pop(number), result

    def _again(self, entries: list[tuple[int, Any]], coming: _Coming, done: dict[int, Any]) -> None:
        """Return the items of a dead process to the queue, and count a death at the first item."""
        if entries and coming.dies(entries[0][0]) >= self.rules.tries:
            number, item = entries.pop(0)
            if self.rules.lost is None:
                died = f"the process died {self.rules.tries} times (out of memory, or killed)"
                raise CaseError("E036", f"{self.describe(item)}: {died}")
            done[number] = item, self.rules.lost(item)
        coming.back(entries)

    def _end(self, processes: list[_Process], *, at_once: bool) -> None:
        for process in processes:
            self._processes.remove(process)
            process.dismiss(at_once=at_once)
        for process in processes:
            process.join()


class _Coming:
    """Numbered items that wait for a process. Items of dead processes come first."""

    def __init__(self, items: Iterable[Any]) -> None:
        self.items = enumerate(items)
        self.again: deque[tuple[int, Any]] = deque()
        self.deaths: Counter[int] = Counter()

    def next(self) -> tuple[int, Any] | None:
        return self.again.popleft() if self.again else next(self.items, None)

    def dies(self, number: int) -> int:
        """Count a death at an item, and return the number of deaths."""
        self.deaths[number] += 1
        return self.deaths[number]

    def back(self, entries: Iterable[tuple[int, Any]]) -> None:
        self.again = deque(sorted([*self.again, *entries], key=lambda entry: entry[0]))


class _Process:
    """Process with a pipe and a queue of items."""

    def __init__(self, state: object, describe: Describe, others: Iterable[_Process]) -> None:
        import multiprocessing
        from multiprocessing import resource_tracker

        # A fork is fast, but not safe while another thread can hold a lock.
        may_hold = [thread for thread in threading.enumerate() if thread.name != TELLING]
        fork = sys.platform == "linux" and len(may_hold) == 1
        context: Any = multiprocessing.get_context("fork" if fork else "spawn")
        if not fork:  # started now, because a signal could interrupt a later start
            resource_tracker.ensure_running()
        self.items: dict[int, Any] = {}
        self.connection, far = context.Pipe()
        inherited = [other.connection for other in others] + [self.connection] if fork else []
        arguments = (state, describe, far, inherited)
        self.process = context.Process(target=_serve, args=arguments, daemon=True)
        with _later(signal.SIGINT, signal.SIGTERM), warnings.catch_warnings():
            # Python warns of forks with several threads, but threads of BLAS do no harm.
            warnings.simplefilter("ignore", DeprecationWarning)
            self.process.start()
        far.close()

    def give(self, number: int, item: Any, function: Work[Any, Any]) -> None:
        self.items[number] = item
        with suppress(OSError):  # the death of a process is noticed when its results are read
            self.connection.send((number, item, function))

    def dismiss(self, *, at_once: bool) -> None:
        self.connection.close()
        if at_once:
            self.process.terminate()

    def join(self) -> None:
        self.process.join(END_SECONDS)
        if self.process.is_alive():
            self.process.kill()
            self.process.join()


@contextmanager
def _later(*signals: signal.Signals) -> Iterator[None]:
    before = signal.pthread_sigmask(signal.SIG_BLOCK, signals)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _serve(
    state: object, describe: Describe, connection: Connection, inherited: Iterable[Connection]
) -> None:
    """Process items until the pipe is closed or the parent ends. Ctrl-C is ignored."""
    for other in inherited:
        other.close()
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGINT, signal.SIGTERM])
    threading.Thread(target=_end_with_parent, daemon=True).start()
    with suppress(EOFError, OSError):  # the pipe is closed
        while True:
            number, item, function = connection.recv()
            try:
                answer: Any = number, call(function, state, item, describe), None
            except (OSError, CaseError) as error:
                answer = number, None, error
            connection.send(answer)
    os._exit(0)


def _end_with_parent() -> None:
    """Let the current process end together with its parent, even in the middle of an item."""
    from multiprocessing import connection, parent_process

    parent = parent_process()
    if parent is not None:
        connection.wait([parent.sentinel])
        os.kill(os.getpid(), signal.SIGTERM)
