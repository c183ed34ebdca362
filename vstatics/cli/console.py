"""What rich prints: names and messages of anybody come out safe, colours are its own.

This module imports rich, which costs start-up time: import it where it is used.
"""

from __future__ import annotations

from collections.abc import Iterable

from rich.console import Console, ConsoleOptions, RenderableType
from rich.segment import Segment

from vstatics.errors import printable


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
