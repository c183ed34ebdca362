"""Ctrl-C and SIGTERM at any moment of any command: a status, no trace, nothing half written."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

import vstatics
from tests.chance import seeded
from tests.commands import NEUTRAL, environment
from tests.installed import skip_without_command
from tests.processes import names, wait_for

COMMANDS = {
    "run": ("run", "pipe"),
    "pretty": ("run", "--pretty", "pipe"),
    "output": ("run", "pipe", "-o", "out.lst"),
    "check": ("check", "pipe"),
    "summary": ("summary", "pipe", "-o", "out.txt"),
    "flow": ("flow", "pipe"),
    "explain": ("explain", "pipe"),
    "plot": ("plot", "pipe", "--kind", "plan", "-o", "out.svg"),
    "report": ("report", "pipe", "-o", "out.html"),
    "convert": ("convert", "pipe", "out.dat"),
    "compare": ("compare", "pipe", "pipe"),
    "combinations": ("synth", "combinations", "pipe", "--write", "out.yaml"),
    "fit": ("synth", "fit", "pipe", "--ratios", "low=2", "--write", "out.yaml"),
    "sweep": ("sweep", "pipe", "--vary", "D.ratio=-3:-2:3", "-o", "out.csv"),
    "table": ("sweep", "box.yaml", "--variants", "pipe", "-o", "out.csv"),
}
PACKAGE = Path(vstatics.__file__).parent
SIGNALS = {signal.SIGINT: 130, signal.SIGTERM: 143}


@pytest.fixture(autouse=True)
def _files(folder: Path) -> None:
    """A case, and a pipe at which a command waits."""
    (folder / "box.yaml").write_text(NEUTRAL, encoding="utf-8")
    os.mkfifo("pipe")


@contextmanager
def running(*arguments: str, **variables: str) -> Iterator[subprocess.Popen[bytes]]:
    """A command in the background; it is killed if the test fails."""
    with subprocess.Popen(
        [sys.executable, "-m", "vstatics", *arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env=environment(**variables),
    ) as process:
        try:
            yield process
        finally:
            process.kill()


@pytest.mark.parametrize("sent", SIGNALS)
@pytest.mark.parametrize(
    "command",
    [pytest.param(one, marks=[pytest.mark.slow] * (one != "run")) for one in COMMANDS],
)
def test_a_command_that_is_stopped_says_so(command: str, sent: signal.Signals) -> None:
    skip_without_command(COMMANDS[command][0])
    with running(*COMMANDS[command]) as process:
        pipe = os.open("pipe", os.O_WRONLY)  # as soon as the command reads
        process.send_signal(sent)
        out, err = process.communicate(timeout=60)
        os.close(pipe)
    assert (process.returncode, out, err) == (SIGNALS[sent], b"", b"stopped\n")
    assert names(Path.cwd()) == ["box.yaml", "pipe"]


def shadowed(module: str) -> str:
    """A folder with a module that tells that its import has begun, and is the real one later."""
    Path("shadow").mkdir()
    lines = (
        "import pathlib, sys, time",
        "pathlib.Path('begun').touch()",
        "time.sleep(.5)",
        "sys.path = [one for one in sys.path if not one.endswith('shadow')]",
        f"del sys.modules[{module!r}]",
        f"import {module}",
    )
    Path("shadow", f"{module}.py").write_text("\n".join(lines), encoding="utf-8")
    return f"shadow{os.pathsep}{environment()['PYTHONPATH']}"


@pytest.mark.parametrize(
    ("module", "said"), [("inspect", b""), ("numpy", b"stopped\n"), ("yaml", b"stopped\n")]
)
def test_an_import_that_is_stopped_leaves_no_trace(module: str, said: bytes) -> None:
    """The package imports `inspect` at once, and NumPy and YAML when they are needed."""
    with running("run", "box.yaml", PYTHONPATH=shadowed(module)) as process:
        wait_for(Path("begun").exists)
        process.send_signal(signal.SIGINT)
        ended = process.communicate(timeout=60)
    assert (process.returncode, ended) == (130, (b"", said))


def test_ctrl_c_is_left_alone_where_the_package_is_a_library() -> None:
    program = "import signal, vstatics; print(signal.getsignal(2) is signal.default_int_handler)"
    line = [sys.executable, "-c", program]
    done = subprocess.run(line, capture_output=True, check=False, env=environment())
    assert done.stdout == b"True\n"


@pytest.mark.slow
def test_ctrl_c_at_any_moment_of_the_start_shows_nothing_of_the_package() -> None:
    """Before the package is reached it is Python that may show a trace, of its own modules."""
    chance = seeded(1)
    for _ in range(100):
        with running("run", "box.yaml") as process:
            time.sleep(chance.uniform(0, 0.08))
            process.send_signal(signal.SIGINT)
            _, err = process.communicate(timeout=60)
        assert f"{PACKAGE}{os.sep}".encode() not in err
