"""Limits on the number and duration of connections. A new connection can end the slowest."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import Iterator
from typing import Literal

MOST_CONNECTED = 200
"""Largest number of connections, below the number of files that a process can have open."""
MOST_LISTENING = 32
"""Largest number of pages that listen for events. A browser opens at most six."""
WRITE_SECONDS = 10.0
"""Time in which a browser must receive a response. [s]"""
LINGERING_SECONDS, LINGERING_BYTES = 2.0, 16_000_000
"""Largest time [s] and size [bytes] in discarding an unread body, so that a refusal arrives."""

Phase = Literal["slow", "busy", "listening"]
"""Phase of a connection: data transfer, calculation of the answer, or waiting for events."""


class Connections:
    """Open connections and their phases, ordered by their last change of phase."""

    def __init__(self) -> None:
        """Begin with no connections."""
        self._phases: dict[asyncio.Task[None], Phase] = {}

    def __len__(self) -> int:
        """Return the number of connections."""
        return len(self._phases)

    @contextlib.contextmanager
    def joined(self) -> Iterator[bool]:
        """Register the current connection within the context; yield whether it has room."""
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
        """Set the phase of the current connection, and move it to the end of the order."""
        task = asyncio.current_task()
        if self._phases.pop(task, None) is None or task is None:  # type: ignore[arg-type] # None is not a key
            return
        if phase == "listening" and [*self._phases.values()].count(phase) >= MOST_LISTENING:
            self._end_first(phase)
        self._phases[task] = phase

    def _end_first(self, phase: Phase) -> bool:
        """End the connection that has been in a phase longest; return whether there was any."""
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
    """Send data to a browser, and wait until it has received all data.

    Raises
    ------
    OSError
        If the browser does not receive the data in time.
    """
    writer.write(data)
    async with asyncio.timeout(WRITE_SECONDS):
        await writer.drain()


async def linger(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
    """Discard incoming data for a while, so that the browser reads the response."""
    with contextlib.suppress(OSError, TimeoutError, RuntimeError):
        writer.write_eof()
        async with asyncio.timeout(LINGERING_SECONDS):
            left = LINGERING_BYTES
            while left > 0 and (read := await reader.read(65_536)):
                left -= len(read)
