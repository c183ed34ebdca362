"""How many may be connected, and how long they may take: whoever is slowest makes room."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import Iterator
from typing import Literal

MOST_CONNECTED = 200
"""Below what a process may have open, with room for files."""
MOST_LISTENING = 32
"""Pages that listen for events; a browser has at most six."""
WRITE_SECONDS = 10.0
"""So long whoever reads an answer may take."""
LINGERING_SECONDS, LINGERING_BYTES = 2.0, 16_000_000
"""What is still sent of a body that nobody reads is thrown away, so that the answer arrives."""

Phase = Literal["slow", "busy", "listening"]
"""Who waits for whom: we for what is sent or taken, a page for an answer, for events."""


class Connections:
    """Those that there are, in their order."""

    def __init__(self) -> None:
        """None yet."""
        self._phases: dict[asyncio.Task[None], Phase] = {}

    def __len__(self) -> int:
        """How many there are."""
        return len(self._phases)

    @contextlib.contextmanager
    def joined(self) -> Iterator[bool]:
        """One more for a while; whether there is room. The slowest of others makes it."""
        task = asyncio.current_task()
        assert task is not None  # noqa: S101 - this is called in one
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
        """What the connection of this task does from now on; it is the last one that does."""
        task = asyncio.current_task()
        if self._phases.pop(task, None) is None or task is None:  # type: ignore[arg-type] # None is no key
            return
        if phase == "listening" and [*self._phases.values()].count(phase) >= MOST_LISTENING:
            self._end_first(phase)
        self._phases[task] = phase

    def _end_first(self, phase: Phase) -> bool:
        """End the one that has been longest in a phase, if there is one."""
        for task, own in self._phases.items():
            if own == phase:
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
    """Send all of it.

    Raises
    ------
    OSError
        If nobody takes it in time.
    """
    writer.write(data)
    async with asyncio.timeout(WRITE_SECONDS):
        await writer.drain()


async def linger(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
    """Throw away what still comes, for a while, so that an answer is not lost with it."""
    with contextlib.suppress(OSError, TimeoutError, RuntimeError):
        writer.write_eof()
        async with asyncio.timeout(LINGERING_SECONDS):
            left = LINGERING_BYTES
            while left > 0 and (read := await reader.read(65_536)):
                left -= len(read)
