"""Terminal output with `rich`. Texts of users are escaped, but not the colours of `rich`.

Import this module only where it is used, because `rich` costs start-up time.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from rich.console import Console, ConsoleOptions, RenderableType
from rich.segment import Segment

from vstatics.core.errors import printable

_BLANKS = re.compile(r"[ ]+((?:\x1b\[[0-9;]*m)*)$", re.MULTILINE)
"""Pattern of blanks at the end of a line, also if codes for colours follow."""


class SafeConsole(Console):
    r"""Console of rich that escapes all printed texts.

    >>> SafeConsole().print("a\x1b[2J")
    a\u001b[2J
    """

    def render(
        self, renderable: RenderableType, options: ConsoleOptions | None = None
    ) -> Iterable[Segment]:
        """Yield the segments of rich, with control characters escaped in the texts."""
        for text, style, control in super().render(renderable, options):
            shown = text if control else printable(text, lines=True)
            yield Segment(shown, style, control)


def trimmed(text: str) -> str:
    r"""Return a text for a terminal without trailing blanks and without empty lines at the end.

    >>> trimmed("gear  \n\x1b[1m1   \x1b[0m\n  \n")
    'gear\n\x1b[1m1\x1b[0m\n'
    """
    return _BLANKS.sub(r"\1", text).rstrip("\n") + "\n"
