"""A page that is served within the tests, and what they say to it over plain sockets."""

import asyncio
import json
import socket
import threading
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

from vstatics.core.cli.shared.cases import CaseOptions
from vstatics.page.cli.serve import calculated
from vstatics.page.serve.server import PageServer
from vstatics.page.serve.states import ShownStates

TOKEN = "0123456789-of-the-tests-Abc"  # noqa: S105 - of a server that ends with its test
BOX = """\
# a set  (kept)
links: [sun, ring, carrier]
shift_elements: {B1: [ring, housing], C1: [sun, ring]}
mechanisms:
  P1:   {first: sun, second: ring, third: carrier, ratio: -78/30,  efficiency: 0.97}  # teeth
gears: {low: [B1], direct: [C1]}
load: {speed: 3000 rpm,   torque: 1.3*400 Nm}
"""


class NoStudio:
    """Draws nothing."""

    def part(self, texts: Mapping[str, bytes], name: str) -> str | None:
        """Its name, for names that begin so."""
        return f"<p>{name}</p>" if texts and name.startswith("flow:") else None

    def stop(self) -> None:
        """There is nothing to end."""

    close = stop


class HttpReply(NamedTuple):
    """What came back."""

    status: int
    fields: dict[str, str]
    body: bytes

    @property
    def told(self) -> Any:
        """What it says in JSON."""
        return json.loads(self.body)


class ServedCase:
    """A case, and the port at which its page is."""

    def __init__(self, file: Path, port: int) -> None:
        self.file = file
        self.port = port
        self.host = f"127.0.0.1:{port}"

    def connect(self) -> socket.socket:
        """A connection that gives up after a while."""
        return socket.create_connection(("127.0.0.1", self.port), timeout=10)

    def said(self, data: bytes) -> HttpReply:
        """What is answered to some bytes."""
        with self.connect() as line:
            line.sendall(data)
            return reply(line)

    def ask(
        self, route: str, body: object = None, method: str = "", fields: Mapping[str, str] = {}
    ) -> HttpReply:
        """What is answered to a request as the page makes it."""
        data = body if isinstance(body, bytes) else json.dumps(body).encode()
        method = method or ("GET" if body is None else "POST")
        lines = [f"{method} /{TOKEN}/{route} HTTP/1.1", f"Host: {self.host}"]
        lines += [f"Content-Length: {len(data)}"] * (body is not None)
        lines += [f"{name}: {value}" for name, value in fields.items()]
        return self.said("\r\n".join([*lines, "", ""]).encode() + data * (body is not None))

    def save(self, changes: Mapping[str, float], **fields: str) -> HttpReply:
        """What is answered to numbers that are to be saved."""
        return self.ask("save", {"changes": changes}, fields=fields)


def reply(line: socket.socket) -> HttpReply:
    """What comes until the connection ends."""
    data = b""
    while read := line.recv(65_536):
        data += read
    head, _, body = data.partition(b"\r\n\r\n")
    first, *fields = head.decode().split("\r\n")
    pairs = (one.split(": ", 1) for one in fields)
    return HttpReply(int(first.split()[1]), {name.lower(): value for name, value in pairs}, body)


@contextmanager
def serving(file: Path) -> Iterator[ServedCase]:
    """Serve a case in a thread, without pictures."""
    begun, stop = threading.Event(), asyncio.Event()
    known: list[tuple[str, asyncio.AbstractEventLoop]] = []
    make = partial(ShownStates, partial(calculated, str(file), CaseOptions()), str(file))
    server = PageServer(make, NoStudio(), TOKEN)  # type: ignore[arg-type] # it draws nothing

    def ready(address: str) -> None:
        known.append((address, asyncio.get_running_loop()))
        begun.set()

    thread = threading.Thread(target=asyncio.run, args=[server.serve(0, ready, stop)])
    thread.start()
    try:
        assert begun.wait(20)
        yield ServedCase(file, int(known[0][0].split(":")[2].split("/")[0]))
    finally:
        known[0][1].call_soon_threadsafe(stop.set)
        thread.join(10)
        assert not thread.is_alive()
