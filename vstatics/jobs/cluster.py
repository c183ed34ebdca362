"""A Dask cluster does the work: machines that run `dask worker`, with this package installed."""

from __future__ import annotations

import logging
import warnings
from collections.abc import Iterable, Iterator
from importlib import import_module
from typing import Any, Self

from vstatics.errors import CaseError, Problem, ReadError, of_file
from vstatics.extras import __version__
from vstatics.jobs.alone import Describe, Item, Result, Work, Workers, failure

PATIENCE = 10
"""Seconds to wait for a scheduler, and then for a first worker."""
RETRIES = 3
LOST = ("CommClosedError", "CancelledError", "FutureCancelledError")
"""How Dask tells that the scheduler went away: while a result was fetched, or before."""


class Cluster(Workers):
    """The workers of a scheduler; see `vstatics.jobs.alone.Workers`."""

    remote = True

    def __init__(self, state: object, describe: Describe, address: str) -> None:
        """Nothing is connected before the context is entered."""
        super().__init__(state, describe)
        self.address = address
        self._client: Any = None
        self._sent: Any = None

    def __enter__(self) -> Self:
        """Connect, compare versions and send the state once to every worker.

        Raises
        ------
        ReadError
            If there is no scheduler, or no worker that can do it.
        """
        distributed = import_module("distributed")  # costs start-up time, and may be missing
        _silence()
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # other versions of Python on the workers, say
            try:
                self._client = distributed.Client(
                    self.address, timeout=PATIENCE, set_as_default=False
                )
                self._client.wait_for_workers(1, timeout=PATIENCE)
            except (OSError, TimeoutError, ValueError) as error:
                self._close()
                raise self._problem(_reason(error)) from None
        try:
            self._check_versions()
            self._sent = self._client.scatter(_Held(self.state), broadcast=True, hash=False)
        except BaseException:
            self._close()
            raise
        return self

    def __exit__(self, *_: object) -> None:
        """Disconnect; what is under way is dropped."""
        self._close()

    def _close(self) -> None:
        client, self._client = self._client, None
        if client is not None:
            client.close(timeout=PATIENCE)

    def _problem(self, message: str) -> ReadError:
        return ReadError([of_file(self.address, message)])

    def _check_versions(self) -> None:
        """Refuse workers without this package, or with another version of it."""
        versions = self._client.run(_version, on_error="return")
        for worker, version in versions.items():
            if isinstance(version, Exception):
                raise self._problem(
                    f"worker {worker} can't do it: {version}; install vstatics {__version__} there"
                )
            if version != __version__:
                message = f"worker {worker} has vstatics {version}, expected {__version__}"
                raise self._problem(message)

    def each(
        self, function: Work[Item, Result], items: Iterable[Item], *, ordered: bool = False
    ) -> Iterator[tuple[Item, Result]]:
        """See `vstatics.jobs.alone.Workers`; pieces of a worker that dies go to the others."""
        entries = enumerate(items)
        under_way: dict[str, tuple[int, Item]] = {}
        done: dict[int, tuple[Item, Result]] = {}
        turn = 0
        finished = import_module("distributed").as_completed(
            loop=self._client.loop, raise_errors=False
        )

        def fill() -> None:
            most = 2 * max(2, sum(self._client.nthreads().values()))
            while len(under_way) + len(done) < most:
                entry = next(entries, None)
                if entry is None:
                    return
                future = self._client.submit(
                    _call, function, self._sent, entry[1], pure=False, retries=RETRIES
                )
                under_way[future.key] = entry
                finished.add(future)

        try:
            fill()
            for future in finished:
                number, item = under_way.pop(future.key)
                done[number] = item, self._result(future, item)
                while done and (not ordered or turn in done):
                    yield done.pop(turn if ordered else next(iter(done)))
                    turn += 1
                fill()
        except OSError:
            raise self._problem("the connection to the scheduler is lost") from None

    def _result(self, future: Any, item: object) -> Any:
        """What a future holds, or an error that names the item."""
        try:
            return future.result()
        except CaseError:
            raise
        except Exception as error:
            if type(error).__name__ in LOST:
                raise self._problem("the connection to the scheduler is lost") from None
            if type(error).__name__ == "KilledWorker":
                message = "the workers that were at it died, one after the other"
                raise CaseError([Problem(f"{self.describe(item)}: {message}")]) from None
            raise failure(self.describe, item, error) from error


def _silence() -> None:
    """What Dask logs is told in better words here, if it is to be told."""
    for name in logging.root.manager.loggerDict:
        if name.partition(".")[0] in ("distributed", "tornado", "asyncio"):
            logging.getLogger(name).setLevel(logging.CRITICAL)


class _Held:
    """Keeps Dask from looking into the state."""

    def __init__(self, state: object) -> None:
        self.state = state


def _version() -> str:
    return __version__


def _call(function: Work[Item, Result], held: _Held, item: Item) -> Result:
    return function(held.state, item)


def _reason(error: Exception) -> str:
    """Why there is no cluster, in one line."""
    if isinstance(error, ValueError):
        return f"is no address of a scheduler, expected tcp://HOST:PORT ({error})"
    if "worker" in str(error).lower():
        return f"the scheduler has no workers (waited {PATIENCE} s for one)"
    return f"no Dask scheduler answers there (waited {PATIENCE} s)"
