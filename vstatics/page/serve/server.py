"""HTTP server of a page: it sends sections, pictures and events, and saves files."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextvars import copy_context
from functools import partial
from typing import Any, TypeVar

from vstatics.page.serve import answers
from vstatics.page.serve.answers import HttpAnswer, as_json, html, refusal
from vstatics.page.serve.connections import Connections, linger, send
from vstatics.page.serve.requests import (
    HOST,
    MOST_HEAD,
    RefusedError,
    Request,
    read_changes,
    read_request,
)
from vstatics.page.serve.states import ChangedMeanwhileError, RefusedChangeError, ShownStates
from vstatics.page.serve.studio import StudioProcess

LOOK_SECONDS = 0.02
"""Time between checks of the files for changes. [s]"""
BEAT_SECONDS = 10.0
"""Time between comments that keep the event stream of a page open. [s]"""
END_TRIES, END_SECONDS = 20, 0.1
"""Number of attempts to end the drawing process, and time for each attempt [s]."""

T = TypeVar("T")


class PageServer:
    """HTTP server of the page of a case.

    Parameters
    ----------
    make : callable
        Function that returns the states of the case.
    studio : StudioProcess
        Process that draws pictures and slow sections.
    token : str
        Secret part of the address; requests without it are refused.
    """

    def __init__(self, make: Callable[[], ShownStates], studio: StudioProcess, token: str) -> None:
        """Prepare the server. Nothing is calculated yet."""
        self._make = make
        self._studio = studio
        self._token = token
        self._port = 0
        self._states: ShownStates
        self._connections = Connections()
        self._news = asyncio.Event()
        self._numbers = ThreadPoolExecutor(1, "numbers")
        """Single thread for all calls that change states, so that they run one after another."""
        self._pictures = ThreadPoolExecutor(1, "pictures")

    async def serve(self, port: int, ready: Callable[[str], None], stop: asyncio.Event) -> None:
        """Serve until the event `stop` is set.

        Parameters
        ----------
        port : int
            Port to listen on; 0 selects a free port.
        ready : callable
            Function that is called with the address when a browser can open it.
        stop : Event

        Raises
        ------
        OSError
            If the port is already in use.
        """
        server = await asyncio.start_server(
            self._connected, HOST, port, limit=MOST_HEAD, backlog=1024
        )
        self._port = server.sockets[0].getsockname()[1]
        watching = None
        try:
            self._states = await self._in(self._numbers, self._make)
            watching = asyncio.create_task(self._watch())
            self._pictures.submit(self._studio.part, self._states.shown.calculated.texts, "")
            ready(f"http://{HOST}:{self._port}/{self._token}/")
            await stop.wait()
        finally:
            server.close()
            if watching:
                watching.cancel()
            await self._connections.end_all()
            await self._end_pictures()
            for pool in (self._numbers, self._pictures):
                pool.shutdown(wait=False)

    async def _end_pictures(self) -> None:
        """End the process that draws pictures, but never during the start of the process."""
        closed = self._in(self._pictures, self._studio.close)
        for _ in range(END_TRIES):
            self._studio.stop()
            if (await asyncio.wait([closed], timeout=END_SECONDS))[0]:
                return

    def _in(self, pool: ThreadPoolExecutor, work: Callable[[], T]) -> asyncio.Future[T]:
        context = copy_context()  # the context includes the language of the page
        return asyncio.get_running_loop().run_in_executor(pool, context.run, work)

    async def _watch(self) -> None:
        """Check the files for changes repeatedly, and inform the listening pages."""
        while True:
            await asyncio.sleep(LOOK_SECONDS)
            if self._states.is_old() and await self._in(self._numbers, self._look_again):
                self._wake_listeners()
                self._in(
                    self._numbers, self._file_state
                )  # the response is cached for the pages that request it next

    def _look_again(self) -> bool:
        return self._states.look_again()

    def _wake_listeners(self) -> None:
        self._news.set()
        self._news = asyncio.Event()

    async def _connected(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        """Handle a connection from the request to the response."""
        writer.transport.set_write_buffer_limits(0)
        try:
            with self._connections.joined() as has_room:
                if has_room:
                    await self._respond(reader, writer)
        except (OSError, EOFError, TimeoutError, asyncio.CancelledError):
            pass  # the browser has closed the connection, or is too slow
        except Exception as error:  # noqa: BLE001 - other connections continue
            writer.write(refusal(RefusedError(500, f"an error of vstatics: {error!r}")).data)
        finally:
            writer.transport.abort() if writer.transport.get_write_buffer_size() else writer.close()

    async def _respond(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        try:
            request = await read_request(reader, self._port, self._token)
            if request.route == "events":
                await self._listened(reader, writer)
                return
            answer = await self._answer(request, reader)
        except RefusedError as error:
            await send(writer, refusal(error).data)
            await linger(reader, writer)
            return
        self._connections.now("slow")
        await send(writer, answer.data)

    async def _answer(self, request: Request, reader: asyncio.StreamReader) -> HttpAnswer:
        """Return the response to a request.

        Raises
        ------
        RefusedError
        """
        changes = await read_changes(request, reader) if request.method == "POST" else {}
        self._connections.now("busy")
        match request.route:
            case "":
                return html(await self._in(self._numbers, self._states.page))
            case "shown":
                return await self._in(self._numbers, self._file_state)
            case "part":
                return await self._awaited(request, reader)
            case "try":
                return await self._in(self._numbers, partial(self._tried, changes))
        digest = "".join(request.all_of("if-match")).strip('"')
        answer = await self._in(self._numbers, partial(self._saved, changes, digest))
        self._wake_listeners()
        return answer

    def _file_state(self) -> HttpAnswer:
        return as_json(self._states.answer(self._states.shown))

    def _tried(self, changes: dict[str, float]) -> HttpAnswer:
        try:
            return as_json(self._states.answer(self._states.tried(changes)))
        except RefusedChangeError as error:
            raise RefusedError(422, str(error)) from None

    def _saved(self, changes: dict[str, float], digest: str) -> HttpAnswer:
        try:
            return as_json(self._states.answer(self._states.saved(changes, digest)))
        except ChangedMeanwhileError:
            raise RefusedError(412, "the file has changed meanwhile") from None
        except RefusedChangeError as error:
            raise RefusedError(422, str(error)) from None

    async def _awaited(self, request: Request, reader: asyncio.StreamReader) -> HttpAnswer:
        """Return a picture or section of a state, unless the browser no longer waits."""
        number, name = request.query.get("number", ""), request.query.get("name", "")
        shown = self._states.kept(number)
        if shown is None or shown.material is None:
            raise RefusedError(404, "this state is not kept")
        work = partial(self._studio.part, shown.calculated.texts, name)
        part = self._in(self._pictures, work)
        gone = asyncio.ensure_future(reader.read(1))
        either: list[asyncio.Future[Any]] = [part, gone]
        await asyncio.wait(either, return_when=asyncio.FIRST_COMPLETED)
        gone.cancel()
        if not part.done():
            part.cancel()
            raise ConnectionResetError
        text = part.result()
        if text is None:
            raise RefusedError(404, "there is no such part")
        return html(text)

    async def _listened(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        """Send the present state of the files, and every later state, as events."""
        self._connections.now("listening")
        await send(writer, answers.head(200, answers.EVENTS, {}) + b"retry: 500\n\n")
        listening = asyncio.ensure_future(self._send_states(writer))
        gone = asyncio.ensure_future(reader.read(1))
        try:
            await asyncio.wait([listening, gone], return_when=asyncio.FIRST_COMPLETED)
        finally:
            listening.cancel()
            gone.cancel()
            await asyncio.gather(listening, gone, return_exceptions=True)

    async def _send_states(self, writer: asyncio.StreamWriter) -> None:
        """Send states as events until the page stops listening."""
        sent = 0
        while True:
            news, shown = self._news, self._states.shown
            if shown.number != sent:
                sent = shown.number
                await send(writer, answers.event(self._states.told_of(shown)))
            try:
                async with asyncio.timeout(BEAT_SECONDS):  # `wait_for` can lose a cancellation
                    await news.wait()
            except TimeoutError:
                await send(writer, b": here\n\n")
