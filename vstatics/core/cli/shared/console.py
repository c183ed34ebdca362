"""What rich prints: names and messages of anybody come out safe, colours are its own.

This module imports rich, which costs start-up time: import it where it is used.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from rich.console import Console, ConsoleOptions, RenderableType
from rich.segment import Segment

from vstatics.core.errors import printable

_BLANKS = re.compile(r"[ ]+((?:\x1b\[[0-9;]*m)*)$", re.MULTILINE)
"""At the end of a line, before the marks that end its colours."""


class SafeConsole(Console):
    r"""A console that escapes the texts it is given.

    >>> SafeConsole().print("a\x1b[2J")
    a\u001b[2J
    """

    def render(
        self, renderable: RenderableType, options: ConsoleOptions | None = None
    ) -> Iterable[Segment]:
        """As rich does, each stretch of text made safe."""
        for text, style, control in super().render(renderable, options):
            shown = text if control else printable(text, lines=True)
            yield Segment(shown, style, control)


def trimmed(text: str) -> str:
    r"""A text for a terminal without blanks at the ends of its lines, and lines at its end.

    >>> trimmed("gear  \n\x1b[1m1   \x1b[0m\n  \n")
    'gear\n\x1b[1m1\x1b[0m\n'
    """
    return _BLANKS.sub(r"\1", text).rstrip("\n") + "\n"
