"""Requests of a browser, read within limits. Requests from other pages are refused."""

from __future__ import annotations

import asyncio
import hmac
import json
import math
import re
from typing import NamedTuple
from urllib.parse import parse_qsl

HOST = "127.0.0.1"
MOST_HEAD = 16_384
"""Largest size of the request line and the header fields together. [bytes]"""
MOST_BODY = 1_000_000
MOST_CHANGES = 10_000
READ_SECONDS = 10.0
"""Time in which a browser must send its request. [s]"""
_LINE = re.compile(r"([A-Za-z]{1,16}) (/[\x21-\x7e]*) HTTP/1\.[01]")
_FIELD = re.compile(r"([!#$%&'*+.^_`|~0-9A-Za-z-]+):[ \t]*([\x20-\x7e\x80-\xff\t]*?)[ \t]*")
METHODS = {"": "GET", "events": "GET", "shown": "GET", "part": "GET", "try": "POST", "save": "POST"}
"""HTTP method of each route, which is the path after the token."""


class RefusedError(Exception):
    """Refusal of a request, with the HTTP status and the reason."""

    def __init__(self, status: int, why: str, fields: dict[str, str] | None = None) -> None:
        super().__init__(why)
        self.status = status
        self.why = why
        self.fields = fields or {}


class Request(NamedTuple):
    """Request of the page to the server."""

    method: str
    route: str
    """Route of the request: a key of `METHODS`."""
    query: dict[str, str]
    fields: list[tuple[str, str]]
    """Header fields, with names in lower case."""

    def all_of(self, name: str) -> list[str]:
        """Return all values of a header field."""
        return [value for field, value in self.fields if field == name]


async def read_request(reader: asyncio.StreamReader, port: int, token: str) -> Request:
    """Read the head of a request, and check the sender.

    Raises
    ------
    RefusedError
    EOFError, OSError
        If the browser has closed the connection.
    """
    try:
        async with asyncio.timeout(READ_SECONDS):
            head = await reader.readuntil(b"\r\n\r\n")
    except asyncio.LimitOverrunError:
        raise RefusedError(431, f"expected a head of at most {MOST_HEAD} bytes") from None
    except TimeoutError:
        raise RefusedError(408, f"expected a request within {READ_SECONDS:g} s") from None
    return checked(head, port, token)


def checked(head: bytes, port: int, token: str) -> Request:
    r"""Return a request after checks of its host, origin, path and method.

    Raises
    ------
    RefusedError

    Examples
    --------
    >>> head = b"GET /secret/part?name=flow:2 HTTP/1.1\r\nHost: 127.0.0.1:8000\r\n\r\n"
    >>> checked(head, 8000, "secret")[:3]
    ('GET', 'part', {'name': 'flow:2'})
    """
    first, *lines = head.decode("latin-1").removesuffix("\r\n\r\n").split("\r\n")
    line = _LINE.fullmatch(first)
    matches = [_FIELD.fullmatch(field) for field in lines]
    if not line or not all(matches):
        raise RefusedError(400, "no request of HTTP/1.1")
    fields = [(match[1].lower(), match[2]) for match in matches if match]
    request = Request(line[1], "", {}, fields)
    _check_sender(request, f"{HOST}:{port}")
    path, _, query = line[2].partition("?")
    begin, _, route = path[1:].partition("/")
    is_ours = hmac.compare_digest(begin.encode("latin-1"), token.encode())
    if not is_ours or "/" not in path[1:] or route not in METHODS:
        raise RefusedError(404, "there is nothing here")
    if request.method != METHODS[route]:
        raise RefusedError(405, f"expected {METHODS[route]}", {"Allow": METHODS[route]})
    return request._replace(route=route, query=dict(parse_qsl(query)))


def _check_sender(request: Request, host: str) -> None:
    """Check that a request is addressed to the server, and does not come from another page."""
    if request.all_of("host") != [host]:
        raise RefusedError(403, f"expected the host {host}, once")
    if any(origin != f"http://{host}" for origin in request.all_of("origin")):
        raise RefusedError(403, "comes from another page")
    # Browsers send this field with every POST. Other programs that know the token can omit it.
    sites = request.all_of("sec-fetch-site")
    if request.method == "POST" and any(origin != "same-origin" for origin in sites):
        raise RefusedError(403, "comes from another page")


async def read_changes(request: Request, reader: asyncio.StreamReader) -> dict[str, float]:
    """Read the changed numbers in the body of a request, by path.

    Raises
    ------
    RefusedError
    EOFError, OSError
        If the browser has closed the connection.
    """
    lengths = request.all_of("content-length")
    if request.all_of("transfer-encoding"):
        raise RefusedError(501, "expected a body with a declared length")
    if not lengths:
        raise RefusedError(411, "expected a body and its length")
    if len(lengths) > 1 or not re.fullmatch(r"[0-9]{1,18}", lengths[0]):
        raise RefusedError(400, "expected one length of the body")
    if int(lengths[0]) > MOST_BODY:
        raise RefusedError(413, f"expected a body of at most {MOST_BODY} bytes")
    try:
        async with asyncio.timeout(READ_SECONDS):
            body = await reader.readexactly(int(lengths[0]))
    except TimeoutError:
        raise RefusedError(408, f"expected a request within {READ_SECONDS:g} s") from None
    return changes_of(body)


def changes_of(body: bytes) -> dict[str, float]:
    """Return the changed numbers in the body of a request, by path.

    Raises
    ------
    RefusedError
        If the body is not `{"changes": {path: number}}`.

    Examples
    --------
    >>> changes_of(b'{"changes": {"P1.teeth.sun": 31}}')
    {'P1.teeth.sun': 31.0}
    """
    wrong = RefusedError(400, 'expected {"changes": {path: number}}')
    try:
        given = json.loads(body.decode())
        changes = given.pop("changes")
        numbers = {path: float(value) for path, value in changes.items()}
    except (ValueError, TypeError, AttributeError, KeyError, OverflowError, RecursionError):
        raise wrong from None
    plain = all(type(value) in (int, float) for value in changes.values())
    if given or not plain or len(numbers) > MOST_CHANGES:
        raise wrong
    if not all(map(math.isfinite, numbers.values())):
        raise wrong
    return numbers
