"""Several processes of this machine do the work; one that dies is replaced."""

from __future__ import annotations

import contextlib
import os
import signal
import sys
import threading
from collections import Counter, deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, wait
from concurrent.futures.process import BrokenProcessPool, ProcessPoolExecutor
from typing import Any, Self, TypeVar

from vstatics.errors import CaseError, Problem
from vstatics.jobs.alone import Describe, failure

Item = TypeVar("Item")
Result = TypeVar("Result")

MOST_DEATHS = 3
"""An item at which so many workers died is given up."""


class Processes:
    """Several processes on this machine."""

    remote = False

    def __init__(self, state: object, describe: Describe, jobs: int) -> None:
        """Nothing is started before the context is entered."""
        self.state = state
        self.describe = describe
        self.jobs = jobs
        self._pool: ProcessPoolExecutor | None = None

    def __enter__(self) -> Self:
        """Start them, before this process has threads."""
        self._start()
        return self

    def __exit__(self, *error: object) -> None:
        """End them; at once if there was an error."""
        if error[0] is not None:
            self._kill()
        elif self._pool is not None:
            self._pool.shutdown()

    def _start(self) -> None:
        import warnings
        from multiprocessing import get_context

        # A fork costs nothing, but is not safe where another thread holds a lock.
        fork = sys.platform == "linux" and threading.active_count() == 1
        self._pool = ProcessPoolExecutor(
            self.jobs,
            mp_context=get_context("fork") if fork else get_context("spawn"),
            initializer=_begin,
            initargs=(self.state,),
        )
        with warnings.catch_warnings():  # Python counts the threads of BLAS, which can stand it
            warnings.simplefilter("ignore", DeprecationWarning)
            self._pool.submit(_ready)

    def _kill(self) -> None:
        """End all processes without waiting for what they are at."""
        pool, self._pool = self._pool, None
        if pool is None:
            return
        running = list((getattr(pool, "_processes", None) or {}).values())
        pool.shutdown(wait=False, cancel_futures=True)
        for process in running:
            process.terminate()
        for process in running:
            process.join()

    def each(
        self,
        function: Callable[[Any, Item], Result],
        items: Iterable[Item],
        *,
        ordered: bool = False,
    ) -> Iterator[tuple[Item, Result]]:
        """See `Workers`."""
        return _Errand(self, function, items, ordered=ordered).results()

    def submit(self, function: Callable[[Any, Item], Result], item: Item) -> Future[Result]:
        """Give an item to whoever is free."""
        if self._pool is None:
            self._start()
        assert self._pool is not None  # noqa: S101
        return self._pool.submit(_call, function, item)


_state: Any = None
"""What a worker process got when it began."""


def _begin(state: object) -> None:
    """Begin as a worker: keep the state, leave Ctrl-C to the parent, and end with it."""
    global _state  # noqa: PLW0603
    _state = state
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    from multiprocessing import connection, parent_process

    parent = parent_process()
    if parent is not None:
        connection.wait([parent.sentinel])
        os.kill(os.getpid(), signal.SIGTERM)


def _ready() -> None:
    pass


def _call(function: Callable[[Any, Item], Result], item: Item) -> Result:
    return function(_state, item)


class _Errand:
    """One run of `each` over several processes."""

    def __init__(
        self,
        workers: Processes,
        function: Callable[[Any, Any], Any],
        items: Iterable[Any],
        *,
        ordered: bool,
    ) -> None:
        self.workers = workers
        self.function = function
        self.ordered = ordered
        self.items = enumerate(items)
        self.again: deque[tuple[int, Any]] = deque()  # were under way when a worker died
        self.deaths: Counter[int] = Counter()
        self.under_way: dict[Future[Any], tuple[int, Any]] = {}
        self.done: dict[int, tuple[Any, Any]] = {}  # waits for its turn
        self.turn = 0

    def results(self) -> Iterator[tuple[Any, Any]]:
        self._fill()
        while self.under_way:
            finished, _ = wait(self.under_way, return_when=FIRST_COMPLETED)
            try:
                for future in finished:
                    number, item = self.under_way[future]
                    self.done[number] = item, future.result()
                    del self.under_way[future]
            except BrokenProcessPool:
                self._replace()
            except (OSError, CaseError):
                raise
            except Exception as error:
                raise failure(self.workers.describe, item, error) from error
            yield from self._in_turn()
            self._fill()

    def _in_turn(self) -> Iterator[tuple[Any, Any]]:
        while self.done:
            number = self.turn if self.ordered else next(iter(self.done))
            if number not in self.done:
                return
            self.turn += 1
            yield self.done.pop(number)

    def _fill(self) -> None:
        """Put so many items under way that nobody waits; one that killed workers goes alone."""
        most = 2 * self.workers.jobs
        while len(self.under_way) + len(self.done) < most or (self.again and not self.under_way):
            suspect = self.again and self.deaths[self.again[0][0]] > 1
            if suspect and self.under_way:
                return
            entry = self.again.popleft() if self.again else next(self.items, None)
            if entry is None:
                return
            try:
                future = self.workers.submit(self.function, entry[1])
            except BrokenProcessPool:
                self.again.appendleft(entry)
                self._replace()
                continue
            self.under_way[future] = entry
            if suspect:
                return

    def _replace(self) -> None:
        """New processes for those that died, and what they were at once more."""
        for future, (number, item) in list(self.under_way.items()):
            with contextlib.suppress(BrokenProcessPool):
                if future.done() and not future.cancelled() and future.exception() is None:
                    self.done[number] = item, future.result()
                    continue
            self.deaths[number] += 1
            if self.deaths[number] >= MOST_DEATHS:
                message = f"the process died {MOST_DEATHS} times (out of memory, or killed)"
                raise CaseError([Problem(f"{self.workers.describe(item)}: {message}")])
            self.again.append((number, item))
        self.again = deque(sorted(self.again, key=lambda entry: entry[0]))
        self.under_way.clear()
        self.workers._kill()  # noqa: SLF001
