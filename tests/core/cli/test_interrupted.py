"""Ctrl-C and SIGTERM at any moment of any command: a status, no trace, nothing half written."""

import os
import signal
import time
from pathlib import Path

import pytest

import vstatics
from tests.chance import seeded, with_slow
from tests.commands import NEUTRAL, environment
from tests.installed import skip_without_command
from tests.processes import names, running, wait_for

COMMANDS = (
    *("run pipe", "run --pretty pipe", "run pipe -o out.lst", "check pipe", "flow pipe"),
    *("summary pipe -o out.txt", "explain pipe", "plot pipe --kind plan -o out.svg"),
    *("report pipe -o out.html", "convert pipe out.dat", "compare pipe pipe"),
    *("synth combinations pipe --write out.yaml", "synth fit pipe --ratios low=2 --write out.yaml"),
    *("sweep pipe --vary D.ratio=-3:-2:3 -o out.csv", "sweep box.yaml --variants pipe -o out.csv"),
)


@pytest.fixture(autouse=True)
def _files(folder: Path) -> None:
    """A case, and a pipe at which a command waits."""
    (folder / "box.yaml").write_text(NEUTRAL, "utf-8")
    os.mkfifo("pipe")


@pytest.mark.parametrize(("sent", "status"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
@pytest.mark.parametrize("command", with_slow(COMMANDS[:1], COMMANDS[1:]))
def test_a_command_that_is_stopped_says_so(command: str, sent: signal.Signals, status: int) -> None:
    skip_without_command(command.split(maxsplit=1)[0])
    with running(*command.split()) as process:
        pipe = os.open("pipe", os.O_WRONLY)  # as soon as the command reads
        process.send_signal(sent)
        out, err = process.communicate(timeout=60)
        os.close(pipe)
    assert (process.returncode, out, err) == (status, b"", b"stopped\n")
    assert names() == ["box.yaml", "pipe"]


SHADOW = """\
import pathlib, sys, time
pathlib.Path('begun').touch()
time.sleep(.5)
sys.path = [one for one in sys.path if not one.endswith('shadow')]
del sys.modules[{module!r}]
import {module}
"""
"""A module that tells that its import has begun, and is the real one later."""


@pytest.mark.parametrize(
    ("module", "said"), [("inspect", b""), ("numpy", b"stopped\n"), ("yaml", b"stopped\n")]
)
def test_an_import_that_is_stopped_leaves_no_trace(module: str, said: bytes) -> None:
    """The package imports `inspect` at once, and NumPy and YAML when they are needed."""
    Path("shadow").mkdir()
    Path("shadow", f"{module}.py").write_text(SHADOW.format(module=module), "utf-8")
    path = f"shadow{os.pathsep}{environment()['PYTHONPATH']}"
    with running("run", "box.yaml", PYTHONPATH=path) as process:
        wait_for(Path("begun").exists)
        process.send_signal(signal.SIGINT)
        ended = process.communicate(timeout=60)
    assert (process.returncode, ended) == (130, (b"", said))


@pytest.mark.slow
def test_ctrl_c_at_any_moment_of_the_start_shows_nothing_of_the_package() -> None:
    """Before the package is reached it is Python that may show a trace, of its own modules."""
    chance, package = seeded(1), Path(vstatics.__file__).parent
    for _ in range(100):
        with running("run", "box.yaml") as process:
            time.sleep(chance.uniform(0, 0.08))
            process.send_signal(signal.SIGINT)
            _, err = process.communicate(timeout=60)
        assert f"{package}{os.sep}".encode() not in err
