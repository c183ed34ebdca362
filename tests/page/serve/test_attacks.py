"""What others than our page may try with the server: it answers none of them, and goes on."""

import json
import resource
import socket
import time
from collections.abc import Iterator
from contextlib import ExitStack

import pytest

from tests.page.serve.served import BOX, TOKEN, ServedCase, reply, serving
from vstatics.page.serve import connections, requests

TEN_MEGABYTES = 10_000_000


@pytest.fixture(scope="module")
def served(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ServedCase]:
    file = tmp_path_factory.mktemp("case") / "box.yaml"
    file.write_text(BOX, "utf-8")
    (file.parent / "other.yaml").write_text("secret: 1", "utf-8")
    with serving(file) as running:
        yield running


@pytest.fixture(autouse=True)
def unharmed(served: ServedCase) -> Iterator[None]:
    """Whatever is tried, no file changes, none appears, and the page is still served."""
    yield
    assert served.file.read_text("utf-8") == BOX
    assert {one.name for one in served.file.parent.iterdir()} == {"box.yaml", "other.yaml"}
    begin = time.monotonic()
    assert served.ask("").status == 200
    assert time.monotonic() - begin < 5


def test_the_page_of_ours_is_answered_and_says_little_to_others(served: ServedCase) -> None:
    for answer in (served.ask(""), served.ask("shown"), served.ask("no"), served.ask("save")):
        fields = answer.fields
        assert fields["cache-control"] == "no-store"
        assert fields["x-content-type-options"] == "nosniff"
        assert fields["referrer-policy"] == "no-referrer"
        assert "frame-ancestors 'none'" in fields["content-security-policy"]
        assert "default-src 'none'" in fields["content-security-policy"]
        assert "unsafe-inline" not in fields["content-security-policy"].split("style-src")[0]
        assert "access-control-allow-origin" not in fields
    assert b"sun" in served.ask("").body


def test_a_host_that_is_not_ours_once_gets_nothing(served: ServedCase) -> None:
    ours = f"127.0.0.1:{served.port}"
    others = ["127.0.0.1", "127.0.0.1:1", f"{ours}.evil.example", f"{ours}, evil.example"]
    others += [f"{host}:{served.port}" for host in ("localhost", "evil.example", "[::1]")]
    several = [[], [ours, ours], [ours, "evil.example"], ["evil.example", ours]]
    for hosts in [*([other] for other in others), *several]:
        fields = "".join(f"Host: {host}\r\n" for host in hosts)
        answer = served.said(f"GET /{TOKEN}/ HTTP/1.1\r\n{fields}\r\n".encode())
        assert answer.status == 403, hosts
        assert b"sun" not in answer.body


def test_a_page_of_others_can_save_nothing(served: ServedCase) -> None:
    """By its origin, or by what a browser sends where it tells no origin."""
    host = served.host
    others = ("http://evil.example", "null", f"https://{host}", f"http://{host}.evil.example", "")
    for origin in others:
        assert served.save({"P1.ratio": -3}, Origin=origin).status == 403, origin
    assert served.save({}, Origin=f"http://{host}").status == 200
    for site in ("cross-site", "same-site", "none"):
        assert served.save({"P1.ratio": -3}, **{"Sec-Fetch-Site": site}).status == 403, site
    assert served.save({}, **{"Sec-Fetch-Site": "same-origin"}).status == 200


def test_no_other_path_leads_anywhere(served: ServedCase) -> None:
    within = "other.yaml ../other.yaml ..%2fother.yaml %2e%2e/%2e%2e/etc/passwd /etc/passwd "
    within += "..\\other.yaml box.yaml part part?number=1&name=../../other.yaml "
    within += "part?number=1&name=/etc/passwd part?number=99999999999999999999&name=flow:1 "
    within += "part?number=%C2%B2&name=flow:1"
    for path in (
        *("", "/", "favicon.ico", TOKEN, f"{TOKEN[:-1]}/", f"{TOKEN}x/", f"{TOKEN.upper()}/"),
        *(f"{TOKEN}/{path}" for path in within.split()),
    ):
        answer = served.said(f"GET /{path} HTTP/1.1\r\nHost: {served.host}\r\n\r\n".encode())
        assert answer.status == 404, path
        assert b"secret" not in answer.body
    assert served.ask("part?number=1&name=flow:1").body == b"<p>flow:1</p>"


def test_no_other_method_is_taken(served: ServedCase) -> None:
    for method in ("HEAD", "PUT", "DELETE", "OPTIONS", "TRACE", "PATCH", "get"):
        for route in ("", "save"):
            assert served.ask(route, b"{}", method=method).status == 405, method
    assert served.ask("", b"{}").status == served.ask("save").status == 405


def test_what_is_no_request_is_refused(served: ServedCase) -> None:
    for head in (
        b"",
        b"\r\n\r\n",
        b"GET\r\n\r\n",
        b"GET / HTTP/1.1\nHost: x\n\n\r\n\r\n",
        b"GET http://127.0.0.1/ HTTP/1.1\r\n\r\n",
        b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03\r\n\r\n",
        b"GET / HTTP/1.1\r\n folded: 1\r\n\r\n",
        b"GET / HTTP/1.1\r\nname : 1\r\n\r\n",
        b"GET / HTTP/1.1\r\na: \0\r\n\r\n",
    ):
        with served.connect() as line:
            line.sendall(head)
            line.shutdown(socket.SHUT_WR)
            data = line.recv(100)
        assert not data or b" 400 " in data, head
    assert served.said(b"GET / HTTP/1.1\r\n" + b"a: b\r\n" * 5000).status == 431


def test_nothing_but_numbers_of_the_case_is_saved(served: ServedCase) -> None:
    right = {"changes": {"P1.ratio": -3}}  # so that all others have a reason of their own
    assert served.ask("try", json.dumps(right).encode()).told["state"] == "good"
    numbers = b'"3"', b"true", b"null", b"NaN", b"1e999", b"[3]", b"9" * 5000
    pairs = [b'"P1.first": 3', b'"../other.yaml": 3', b'"P1.ratio": -3, "secret": 2', b'"": 3']
    pairs += [b'"P1.efficiency": 7', *(b'"P1.ratio": ' + number for number in numbers)]
    for body in (
        *(b"", b"{", b"[]", b"null", b'{"changes": []}', b'{"P1.ratio": -3}', b"[" * 100_000),
        *(b'{"changes": {' + pair + b"}}" for pair in pairs),
        *(b'{"changes": {"P1.ratio": -3}, "file": "other.yaml"}', b'\xff{"changes": {}}'),
    ):
        for route in ("save", "try"):
            answer = served.ask(route, body)
            if answer.status == 200:  # a try may show why it can't be
                assert (route, answer.told["state"]) == ("try", "error"), body
            else:
                assert 400 <= answer.status < 500, body


def test_a_body_of_unclear_length_is_refused(served: ServedCase) -> None:
    length = "Content-Length: "
    for fields in (
        "",
        f"{length}5\r\n{length}6\r\n",
        *(f"{length}{number}\r\n" for number in ("-1", "+5", "0x10")),
        f"{length}5\r\nTransfer-Encoding: chunked\r\n",
        "Transfer-Encoding: chunked\r\n",
    ):
        head = f"POST /{TOKEN}/save HTTP/1.1\r\nHost: {served.host}\r\n{fields}\r\n"
        answer = served.said(head.encode() + b"5\r\nhello\r\n0\r\n\r\n")
        assert answer.status in (400, 411, 501), fields


def test_a_large_body_is_refused_before_it_comes(served: ServedCase) -> None:
    head = f"POST /{TOKEN}/save HTTP/1.1\r\nHost: {served.host}\r\n"
    head += f"Content-Length: {TEN_MEGABYTES}\r\n\r\n"
    with served.connect() as line:
        line.sendall(head.encode())
        line.settimeout(5)
        assert line.recv(100).startswith(b"HTTP/1.1 413 ")
    with served.connect() as line:  # who sends it all the same gets the answer, too
        line.sendall(head.encode() + b"x" * TEN_MEGABYTES)
        assert reply(line).status == 413


def test_a_thousand_connections_or_listeners_leave_room_for_one_more(served: ServedCase) -> None:
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (min(4096, hard), hard))
    with ExitStack() as stack:
        stack.callback(resource.setrlimit, resource.RLIMIT_NOFILE, (soft, hard))
        for number in range(1000):
            line = stack.enter_context(served.connect())
            line.sendall(b"GET / HTTP/1.1\r\n"[: number % 17])
        begin = time.monotonic()
        assert served.ask("").status == 200
        assert time.monotonic() - begin < 5
    head = f"GET /{TOKEN}/events HTTP/1.1\r\nHost: {served.host}\r\n\r\n".encode()
    with ExitStack() as stack:
        for _ in range(300):
            stack.enter_context(served.connect()).sendall(head)
        last = stack.enter_context(served.connect())
        last.sendall(head)
        assert last.recv(20).startswith(b"HTTP/1.1 200 OK")
        assert served.ask("").status == 200


def test_who_is_slow_keeps_nobody_from_the_page(
    served: ServedCase, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Neither who sends a letter a minute, nor who sends no body, nor who reads nothing."""
    monkeypatch.setattr(requests, "READ_SECONDS", 0.3)
    monkeypatch.setattr(connections, "WRITE_SECONDS", 0.3)
    whole = f"GET /{TOKEN}/ HTTP/1.1\r\nHost: {served.host}\r\n\r\n".encode()
    without_body = whole.replace(b"GET", b"POST").replace(b"/ HTTP", b"/save HTTP")
    without_body = without_body.replace(b"\r\n\r\n", b"\r\nContent-Length: 9\r\n\r\n")
    with ExitStack() as stack:
        lines = {}
        for name, data in {"letter": b"G", "body": without_body, "reads": whole}.items():
            line = lines[name] = socket.socket()
            stack.enter_context(line)
            line.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 2048)
            line.connect(("127.0.0.1", served.port))
            line.settimeout(10)
            line.sendall(data)
        assert served.ask("").status == 200
        assert reply(lines["letter"]).status == reply(lines["body"]).status == 408


def test_nobody_but_this_computer_is_listened_to(served: ServedCase) -> None:
    for address in ("127.0.0.2", "::1"):
        with pytest.raises(OSError):
            socket.create_connection((address, served.port), timeout=2)
