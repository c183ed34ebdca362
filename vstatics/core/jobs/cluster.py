"""Workers of a Dask cluster: machines that run `dask worker`, with this package installed."""

from __future__ import annotations

import asyncio
import logging
import time
import warnings
from collections.abc import Iterable, Iterator
from importlib import import_module
from typing import Any, NamedTuple, Self

from vstatics.core.errors import CaseError, ReadError, of_file
from vstatics.core.extras import __version__, build
from vstatics.core.jobs.alone import Describe, Item, Result, Work, Workers, failure

SCHEDULER_SECONDS = 10
"""Longest time to wait for a scheduler, and then for the first worker. [s]"""
RETRIES = 3
LOST = ("CommClosedError", "CancelledError", "FutureCancelledError")
"""Names of Dask errors for the loss of the scheduler or of all workers with the state."""


class Cluster(Workers):
    """Workers of a Dask scheduler; see `vstatics.core.jobs.alone.Workers`."""

    remote = True

    def __init__(self, state: object, describe: Describe, address: str) -> None:
        super().__init__(state, describe)
        self.address = address
        self._client: Any = None
        self._sent: Any = None

    def __enter__(self) -> Self:
        """Connect to the scheduler, compare the builds of the package, and send workers the state.

        Raises
        ------
        ReadError
            If no scheduler answers, or no worker has this build of the package.
        """
        distributed = import_module("distributed")  # costs start-up time, and can be missing
        # Failures in Dask are reported as problems instead.
        for name in logging.root.manager.loggerDict:
            if name.partition(".")[0] in ("distributed", "tornado", "asyncio"):
                logging.getLogger(name).setLevel(logging.CRITICAL)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # Dask warns of other Python versions on workers
            try:
                self._client = distributed.Client(
                    self.address, timeout=SCHEDULER_SECONDS, set_as_default=False
                )
                self._client.wait_for_workers(1, timeout=SCHEDULER_SECONDS)
            except (OSError, TimeoutError, ValueError) as error:
                self._close()
                raise self._problem(_reason(error)) from None
        try:
            self._check_builds()
            self._sent = self._client.scatter(_Held(self.state), broadcast=True, hash=False)
        except BaseException:
            self._close()
            raise
        return self

    def __exit__(self, *_: object) -> None:
        """Disconnect, and abandon items in progress."""
        self._close()

    def _close(self) -> None:
        client, self._client = self._client, None
        if client is not None:
            client.close(timeout=SCHEDULER_SECONDS)

    def _problem(self, message: str) -> ReadError:
        return ReadError([of_file("E028", self.address, message)])

    def _check_builds(self) -> None:
        for worker, version in self._client.run(_version, on_error="return").items():
            if isinstance(version, Exception):
                message = f"cannot calculate: {version}; install vstatics {__version__} there"
            elif version != _version():
                message = f"has vstatics {version}, expected {_version()}"
            else:
                continue
            raise self._problem(f"worker {worker} {message}")

    def _loss(self, error: Exception) -> ReadError:
        """Return the error for a lost scheduler or for lost workers.

        Dask can raise the same error for both. Whether the scheduler answers shows which is lost.
        """
        client = self._client
        is_scheduler_lost = getattr(error, "reason", None) == "scheduler-connection-lost"
        if is_scheduler_lost or client.status != "running" or not client.sync(_answers, client):
            return self._problem("the connection to the scheduler is lost")
        return self._problem("all workers are lost, or all that were there in the beginning")

    def each(
        self, function: Work[Item, Result], items: Iterable[Item], *, ordered: bool = False
    ) -> Iterator[tuple[Item, Result]]:
        """Process the items on the cluster. Items of a lost worker go to other workers."""
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
        except OSError as error:
            raise self._loss(error) from None

    def _result(self, future: Any, item: object) -> Any:
        """Return the result of a Dask future, which must be from the same build of the package.

        A worker with another build can join after the first comparison of builds.

        Raises
        ------
        CaseError
            If the item fails, or a worker has another build.
        """
        answer = self._answer(future, item)
        if isinstance(answer, _Answer) and answer.version == _version():
            return answer.result
        self._check_builds()
        raise self._problem("a worker had another build of vstatics, and is gone")

    def _answer(self, future: Any, item: object) -> Any:
        try:
            return future.result()
        except CaseError:
            raise
        except Exception as error:
            if type(error).__name__ in LOST or self._client.status != "running":
                raise self._loss(error) from None
            self._check_builds()
            if type(error).__name__ == "KilledWorker":
                message = "several workers died on this task, one after the other"
                raise CaseError("E029", f"{self.describe(item)}: {message}") from None
            raise failure(self.describe, item, error) from error


async def _answers(client: Any) -> bool:
    """Return whether the scheduler answers. The Dask client notices a loss only later."""
    request = asyncio.ensure_future(client.scheduler.ncores(workers=None))
    end = time.monotonic() + SCHEDULER_SECONDS
    while client.status == "running" and not request.done() and time.monotonic() < end:
        await asyncio.wait([request], timeout=0.1)
    request.cancel()
    answers = await asyncio.gather(request, return_exceptions=True)
    return client.status == "running" and not isinstance(answers[0], BaseException)


class _Held:
    """Wrapper that hides the content of the state from Dask."""

    def __init__(self, state: object) -> None:
        self.state = state


class _Answer(NamedTuple):
    """Result of an item, and the build of the package of the worker."""

    version: str
    result: Any


def _version() -> str:
    return f"{__version__} (build {build()})"


def _call(function: Work[Item, Result], held: _Held, item: Item) -> _Answer:
    return _Answer(_version(), function(held.state, item))


def _reason(error: Exception) -> str:
    if isinstance(error, ValueError):
        return f"is not the address of a scheduler, expected tcp://HOST:PORT ({error})"
    if "worker" in str(error).lower():
        return f"the scheduler has no workers (waited {SCHEDULER_SECONDS} s)"
    return f"no Dask scheduler answers there (waited {SCHEDULER_SECONDS} s)"
