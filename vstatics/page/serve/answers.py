"""HTTP responses: a head with security fields for the browser, and a body."""

from __future__ import annotations

import json
from collections.abc import Mapping
from http import HTTPStatus
from typing import Any, NamedTuple

from vstatics.core.model.empty import EMPTY
from vstatics.core.texts import spoken
from vstatics.page.serve.page import policy_in
from vstatics.page.serve.requests import RefusedError

_ALWAYS = {
    "Cache-Control": "no-store",
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Connection": "close",
}
HTML, JSON, TEXT, EVENTS = (
    f"{kind}; charset=utf-8"
    for kind in ("text/html", "application/json", "text/plain", "text/event-stream")
)


class HttpAnswer(NamedTuple):
    """HTTP response: status, content type, body and other header fields."""

    status: int
    kind: str
    body: bytes
    fields: Mapping[str, str] = EMPTY

    @property
    def data(self) -> bytes:
        """Whole response as bytes."""
        fields = {**self.fields, "Content-Length": f"{len(self.body)}"}
        return head(self.status, self.kind, fields) + self.body


def head(status: int, kind: str, fields: Mapping[str, str]) -> bytes:
    """Return the head of a response as bytes."""
    lines = [f"HTTP/1.1 {status} {HTTPStatus(status).phrase}", f"Content-Type: {kind}"]
    policy = {"Content-Security-Policy": policy_in(spoken())}
    lines += [f"{name}: {value}" for name, value in {**_ALWAYS, **policy, **fields}.items()]
    return ("\r\n".join(lines) + "\r\n\r\n").encode("latin-1")


def html(text: str) -> HttpAnswer:
    """Return a response with HTML: a page or one of its sections."""
    return HttpAnswer(200, HTML, text.encode(errors="backslashreplace"))


def as_json(data: dict[str, Any], status: int = 200) -> HttpAnswer:
    """Return a response with JSON data for the script of the page."""
    text = json.dumps(data, ensure_ascii=False, allow_nan=False)
    return HttpAnswer(status, JSON, text.encode(errors="backslashreplace"))


def refusal(error: RefusedError) -> HttpAnswer:
    """Return the response to a refused request, with the reason as text."""
    return HttpAnswer(error.status, TEXT, f"{error.why}\n".encode(), error.fields)


def event(data: dict[str, Any]) -> bytes:
    r"""Return a server-sent event with JSON data for the script of the page.

    >>> event({"number": 3})
    b'data: {"number": 3}\n\n'
    """
    return f"data: {json.dumps(data)}\n\n".encode()
