"""Programs that serve, none of which outlives its test, and their windows."""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.page.serve.served import BOX
from tests.page.serve.windows import Program, Window, started


@pytest.fixture(autouse=True)
def _ended() -> Iterator[None]:
    """No program outlives its test."""
    yield
    while started:
        if (left := started.pop()).process.poll() is None:
            left.end()


@pytest.fixture
def program(tmp_path: Path) -> Program:
    file = tmp_path / "box.yaml"
    file.write_text(BOX, "utf-8")
    return Program(file)


@pytest.fixture
def window(browser: Any, program: Program) -> Iterator[Callable[[], Window]]:
    opened: list[Window] = []

    def new() -> Window:
        opened.append(Window(browser, program))
        return opened[-1]

    yield new
    for one in opened:
        assert not one.errors
        one.context.close()
