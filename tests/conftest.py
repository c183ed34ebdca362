"""Options of the test run."""

import contextlib
import gc
import os
import shutil
import signal
from collections.abc import Generator
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest
from _pytest.doctest import DoctestItem, DoctestModule
from hypothesis import HealthCheck, settings

from tests.chance import FRESH, count
from tests.installed import HERE, TESTS, is_tested, missing, needs, used_in
from tests.selection import is_in_full, selected

# The same examples every time, so that a run that fails fails again; others and more by `make nightly`.
settings.register_profile(
    "repeatable",
    derandomize=not FRESH,
    database=None,
    deadline=None,
    max_examples=count(16, 120),
    suppress_health_check=[HealthCheck.too_slow],  # of a machine that does other things
)
settings.load_profile("repeatable")


def pytest_configure(config: pytest.Config) -> None:
    """Let programs that are tried be stopped by Ctrl-C, also where a shell has us in the background.

    Only slow tests compile functions: it would take longer than all the rest, and examples call
    parts of the search that cannot be called from Python once they are compiled.
    """
    config.pluginmanager.register(Selection())
    config.pluginmanager.register(BROWSER)
    if FRESH:
        config.option.hypothesis_seed = int(FRESH)
    else:
        without_constants()
    if not config.option.markexpr.startswith("slow"):
        os.environ["NUMBA_DISABLE_JIT"] = "1"
    if getattr(config.option, "numprocesses", None):
        # Several processes use all cores, so threads of BLAS would only wait for one another.
        os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    gc.disable()


def without_constants() -> None:
    """Keep Hypothesis from drawing constants of the package.

    To collect them, each process would parse all modules. Examples then also stay the same when a
    constant changes. `make nightly` draws constants.
    """
    with contextlib.suppress(ImportError):  # older versions lack them
        from hypothesis.internal.conjecture import providers

        empty = getattr(providers, "_local_constants", None)
        setattr(providers, "_get_local_constants", lambda: empty)  # noqa: B010


def pytest_sessionstart(session: pytest.Session) -> None:
    """Import different tests first in each process; the processes share the rewritten asserts."""
    worker = getattr(session.config, "workerinput", None)
    if worker is None or session.config.args != session.config.getini("testpaths"):
        return
    number = int(worker["workerid"].removeprefix("gw"))
    for path in sorted(filter(is_tested, TESTS.rglob("test_*.py")))[
        number :: worker["workercount"]
    ]:
        with contextlib.suppress(ImportError, pytest.skip.Exception):
            import_module(".".join(path.relative_to(TESTS.parent).with_suffix("").parts))


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Skip examples in docstrings that use an annex which is not installed."""
    for item in items:
        if isinstance(item, DoctestItem) and item.dtest is not None:
            text = "".join(example.source for example in item.dtest.examples)
            if missing(used_in(text)):
                item.add_marker(needs(*used_in(text)))


class Selection:
    """Choice of the cases of each test, made after marks have left out other tests."""

    @pytest.hookimpl(trylast=True)
    def pytest_collection_modifyitems(
        self, config: pytest.Config, items: list[pytest.Item]
    ) -> None:
        """Leave out the cases that `--cases` does not ask for."""
        taken, left = selected(items, config.getoption("--cases"))
        if left:
            config.hook.pytest_deselected(items=left)
        BROWSER.files = {
            item.path for item in taken if "browser" in getattr(item, "fixturenames", ())
        }
        # Files taken in full come first, then files that share a browser, so that one process
        # builds what they share.
        items[:] = sorted(
            taken, key=lambda item: (not is_in_full(item.path), item.path not in BROWSER.files)
        )


class SharedBrowser:
    """Browser that all files share, because starting a browser takes as long as ten tests.

    It ends before a test of any other file: while its thread runs, no process can be forked.
    """

    def __init__(self) -> None:
        self.files: set[Path] = set()
        self._open: Any = None
        self._stack = contextlib.ExitStack()

    def opened(self) -> Any:
        """Return the browser, started if it is not open."""
        if self._open is None:
            sync_api = pytest.importorskip("playwright.sync_api")
            chromium = self._stack.enter_context(sync_api.sync_playwright()).chromium
            self._open = chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
            self._stack.callback(self._open.close)
        return self._open

    def pytest_runtest_setup(self, item: pytest.Item) -> None:
        """End the browser where it is not needed."""
        if item.path not in self.files:
            self.pytest_sessionfinish()

    def pytest_sessionfinish(self) -> None:
        """End the browser."""
        self._open = None
        self._stack.close()


BROWSER = SharedBrowser()


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """State that tests in a browser were skipped, if none is installed."""
    if CHROMIUM is None:
        terminalreporter.write_line(
            "Chromium is not installed, so the tests in a browser were skipped (make browser)"
        )


def pytest_collection_finish() -> None:
    """Collect garbage again: tests and modules all stay, so a search among them was in vain."""
    gc.freeze()
    gc.enable()


def pytest_ignore_collect(collection_path: Path) -> bool | None:
    """Leave out files of tests that need an annex which is not installed."""
    if collection_path.suffix != ".py" or not collection_path.is_relative_to(TESTS):
        return None
    return None if is_tested(collection_path) else True


@pytest.hookimpl(wrapper=True)
def pytest_collect_file(
    file_path: Path,
) -> Generator[None, list[pytest.Collector], list[pytest.Collector]]:
    """Search for examples only in modules that have some, and not in tests."""
    collectors = yield
    others = [each for each in collectors if not isinstance(each, DoctestModule)]
    if others == collectors or file_path.name.startswith("test_"):
        return others
    return collectors if b">>> " in file_path.read_bytes() else others


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--cases",
        choices=("first", "other", "all"),
        default="all",
        help="first: the first case of each test, and all published and oracle tests; "
        "other: all other cases",
    )
    parser.addoption(
        "--regenerate",
        action="store_true",
        help="rewrite tests/golden; a test fails where something changed, and shows it",
    )
    parser.addoption("--wheel", help="the wheel that tests/test_wheel.py tries, not a new one")
    parser.addoption(
        "--kills",
        type=int,
        default=count(2, 40),
        help="so often tests/core/cli/test_killed.py kills work of each kind",
    )


@pytest.fixture(scope="module", autouse=True)
def frozen() -> None:
    """Whatever lives by now lives to the end: the collector need not go through it again."""
    gc.collect()
    gc.freeze()


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Empty folder, the current one during the test."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def without_pictures(monkeypatch: pytest.MonkeyPatch) -> None:
    """Reports have none: they take the most time."""
    if "page" not in HERE:
        return
    from vstatics.page.report.page_pictures import Pictures

    monkeypatch.setattr("vstatics.page.report.material.pictures", lambda *_, **__: Pictures())


@pytest.fixture
def regenerate(request: pytest.FixtureRequest) -> bool:
    """Whether golden files are to be rewritten."""
    return bool(request.config.getoption("--regenerate"))


CHROMIUM = shutil.which("chromium")


@pytest.fixture(scope="module")
def browser() -> Any:
    """Debian's chromium, driven by playwright; skipped without them."""
    if CHROMIUM is None:
        pytest.skip("needs chromium")
    return BROWSER.opened()
