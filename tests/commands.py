"""The command line as tests call it: within this process, or as a process of its own."""

import fcntl
import json
import os
import pty
import re
import struct
import subprocess
import sys
import termios
from pathlib import Path
from typing import Any, NamedTuple

from click.testing import CliRunner

from tests.installed import skip_without, skip_without_command, used_in
from vstatics.core.cli import main

ROOT = Path(__file__).parents[1]
CASES = ROOT / "cases"
BAD_FILES = ROOT / "tests/bad"
MZKT = CASES / "mzkt7922.dat"
SHIPPED = sorted(path for path in CASES.iterdir() if path.is_file())
"""All cases that come with the program; a folder beside them has scenarios."""
SCENARIOS = [
    path for path in sorted((CASES / "scenarios").glob("*.yaml")) if "samples" not in path.name
]

NEUTRAL = """\
links: 3
shift_elements: {C: [1, 2], B: [2, housing]}
mechanisms: {D: {first: 1, second: 2, third: 3, ratio: -2.5, efficiency: 0.96}}
gears: {N: {}, low: {engaged: [B]}}
"""
"""A differential with clutch and brake; nothing is engaged in its first gear."""
TIED_UP = NEUTRAL.replace("N: {}", "both: {engaged: [C, B]}")
"""The clutch and the brake hold the input."""
LOCKED = """\
links: 3
output: 2
shift_elements: {T: [1, housing]}
mechanisms: {D: {first: 1, second: 2, third: 3, ratio: 1.004, efficiency: 0.98}}
gears: {"1": {engaged: [T], input: 2, output: 3}}
"""
"""251 to 1 driven from its slow end: friction locks it."""
BAD = NEUTRAL.replace("ratio: -2.5, efficiency: 0.96", "ratoi: -2.5")
"""A mistyped key in line 3."""


ID = re.compile(r" \[[EWN]\d{3}\]$", re.MULTILINE)
"""The id at the end of a message; `tests/test_messages.py` looks at them."""


class Said(NamedTuple):
    """What a call of the command line gave; messages are without their ids."""

    status: int
    out: str
    err: str

    @property
    def all(self) -> str:
        """Everything that was printed."""
        return self.out + self.err

    @property
    def json(self) -> Any:
        """The document on stdout."""
        return json.loads(self.out)

    def is_without_messages(self) -> bool:
        """Return whether the call succeeds: status 0, an empty stderr."""
        return (self.status, self.err) == (0, "")

    def is_silent(self) -> bool:
        """Return whether the call succeeds and prints nothing."""
        return self.is_without_messages() and not self.out

    def is_wrong_use(self, *words: str) -> bool:
        """Return whether the call is rejected: status 2, all words on stderr, an empty stdout."""
        return (self.status, self.out) == (2, "") and self._reports(words)

    def fails(self, *words: str) -> bool:
        """Return whether the call fails: status 1, all words on stderr."""
        return self.status == 1 and self._reports(words)

    def gives_nothing(self, *words: str) -> bool:
        """Return whether the call fails without a result: status 1, an empty stdout."""
        return self.out == "" and self.fails(*words)

    def _reports(self, words: tuple[str, ...]) -> bool:
        return all(word in self.err for word in words)


def vstatics(*arguments: object, stdin: bytes = b"") -> Said:
    """Call a command within this process; an exception passes through.

    Here and below a test is skipped where the annex of the command is not installed.
    """
    skip_without_command(*arguments)
    result = CliRunner().invoke(
        main, [str(one) for one in arguments], input=stdin, catch_exceptions=False
    )
    return Said(result.exit_code, result.stdout_bytes.decode(), ID.sub("", result.stderr))


def json_answer(*arguments: object, stdin: bytes = b"") -> Any:
    """Call a command with `-f json`, and return the document that it prints."""
    return vstatics(*arguments, "-f", "json", stdin=stdin).json


def json_file(path: Path) -> Any:
    """Read a document from a file."""
    return json.loads(path.read_text("utf-8"))


def environment(**variables: str) -> dict[str, str]:
    """The environment of a process that finds this package."""
    kept = {key: value for key, value in os.environ.items() if key not in variables}
    return {**kept, "PYTHONPATH": str(ROOT), **variables}


def process(
    *arguments: object, stdin: bytes = b"", cwd: Path = ROOT, **variables: str
) -> tuple[int, bytes, bytes]:
    """Call ``python -m vstatics`` as a process; exit status, stdout and stderr."""
    skip_without_command(*arguments)
    line = [sys.executable, "-m", "vstatics", *map(str, arguments)]
    return _ended(line, stdin, cwd, **variables)


def shell(command: str, **variables: str) -> tuple[int, bytes, bytes]:
    """Run a line of bash with `pipefail` in the repository; ``vstatics`` is this one."""
    skip_without(*used_in(command))
    line = f'set -o pipefail; vstatics() {{ "{sys.executable}" -m vstatics "$@"; }}; {command}'
    return _ended(["bash", "-c", line], b"", ROOT, **variables)


def _ended(line: list[str], stdin: bytes, cwd: Path, **variables: str) -> tuple[int, bytes, bytes]:
    done = subprocess.run(
        line,
        input=stdin,
        capture_output=True,
        check=False,
        cwd=cwd,
        env=environment(**variables),
        timeout=60,
    )
    return done.returncode, done.stdout, done.stderr


def on_terminal(
    *arguments: str, cwd: Path = ROOT, terminal: str = "xterm-256color", **variables: str
) -> str:
    """What a command shows on a terminal of 80 columns."""
    skip_without_command(*arguments)
    main, other = pty.openpty()
    fcntl.ioctl(other, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 80, 0, 0))
    command = [sys.executable, "-m", "vstatics", *arguments]
    with subprocess.Popen(
        command,
        stdin=other,
        stdout=other,
        stderr=other,
        cwd=cwd,
        env=environment(TERM=terminal, **variables),
    ) as running:
        os.close(other)
        shown = b""
        while True:
            try:
                piece = os.read(main, 65536)
            except OSError:  # Linux: the other end is closed
                break
            if not piece:
                break
            shown += piece
        running.wait()
    os.close(main)
    return shown.decode().replace("\r\n", "\n")
