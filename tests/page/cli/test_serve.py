"""`vstatics serve` where it serves nothing; what it serves is looked at in tests/page/serve."""

import socket

from tests.commands import CASES, vstatics


def test_a_port_that_is_taken_is_reported() -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = str(taken.getsockname()[1])
        said = vstatics("serve", str(CASES / "simpson.yaml"), "--port", port)
    assert said.gives_nothing(f"port {port} cannot be used: Address already in use")


def test_what_cannot_be_served_is_reported() -> None:
    for words in (["serve"], ["report", "--watch"]):
        said = vstatics(*words, "gone.yaml")
        assert said.gives_nothing("gone.yaml: error: cannot be read: No such file or directory")
        assert vstatics(*words, "-").is_wrong_use("expected a file")
    case = str(CASES / "simpson.yaml")
    assert vstatics("report", case).status == 2
    assert vstatics("report", case, "--watch", "-o", "x.html").status == 2
    assert vstatics("report", case, case, "--watch").status == 2
