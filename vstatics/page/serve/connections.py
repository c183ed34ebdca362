"""Limits on the number and duration of connections; the slowest is ended in favour of a new one."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import Iterator
from typing import Literal

MOST_CONNECTED = 200
"""Largest number of connections, below the limit of open files of a process."""
MOST_LISTENING = 32
"""Largest number of pages that listen for events; a browser has at most six."""
WRITE_SECONDS = 10.0
"""Time a browser can take to receive a response. [s]"""
LINGERING_SECONDS, LINGERING_BYTES = 2.0, 16_000_000
"""Limits for discarding the unread body of a refused request, so that the response arrives."""

Phase = Literal["slow", "busy", "listening"]
"""Phase of a connection: data sent or received, answer calculated, or waiting for events."""


class Connections:
    """Open connections with their phases, in the order of the last change of phase."""

    def __init__(self) -> None:
        """Begin without connections."""
        self._phases: dict[asyncio.Task[None], Phase] = {}

    def __len__(self) -> int:
        """Return the number of connections."""
        return len(self._phases)

    @contextlib.contextmanager
    def joined(self) -> Iterator[bool]:
        """Register the current connection within the context; yield whether room was left."""
        task = asyncio.current_task()
        assert task is not None  # noqa: S101 - the server calls this within a task
        has_room = len(self) < MOST_CONNECTED or self._end_first("slow")
        if not has_room:
            yield False
            return
        self._phases[task] = "slow"
        try:
            yield True
        finally:
            self._phases.pop(task, None)

    def now(self, phase: Phase) -> None:
        """Set the phase of the current connection, which becomes the last in order."""
        task = asyncio.current_task()
        if self._phases.pop(task, None) is None or task is None:  # type: ignore[arg-type] # None is not a key
            return
        if phase == "listening" and [*self._phases.values()].count(phase) >= MOST_LISTENING:
            self._end_first(phase)
        self._phases[task] = phase

    def _end_first(self, phase: Phase) -> bool:
        """End the connection that has been in the given phase for the longest time, if any."""
        for task, task_phase in self._phases.items():
            if task_phase == phase:
                del self._phases[task]
                task.cancel()
                return True
        return False

    async def end_all(self) -> None:
        """End every connection."""
        tasks = [*self._phases]
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)


async def send(writer: asyncio.StreamWriter, data: bytes) -> None:
    """Send all data.

    Raises
    ------
    OSError
        If the browser does not receive the data in time.
    """
    writer.write(data)
    async with asyncio.timeout(WRITE_SECONDS):
        await writer.drain()


async def linger(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
    """Discard data that still arrive for a while, so that the response is not lost."""
    with contextlib.suppress(OSError, TimeoutError, RuntimeError):
        writer.write_eof()
        async with asyncio.timeout(LINGERING_SECONDS):
            left = LINGERING_BYTES
            while left > 0 and (read := await reader.read(65_536)):
                left -= len(read)
