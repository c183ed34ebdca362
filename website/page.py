"""A page before Sphinx has it."""

from __future__ import annotations

from typing import NamedTuple

KINDS = ("start", "cookbook", "how-to", "reference", "api", "gallery", "messages", "sources")


class Page(NamedTuple):
    """A page of the site."""

    kind: str
    """One of `KINDS`."""
    name: str
    """Its file in the site without suffix: `how-to/sweep`."""
    text: str
    """In Markdown, or in reStructuredText."""
    suffix: str = ".md"
    """Of what it is written in."""


def anchor(name: str) -> str:
    """A place that links lead to, in Markdown.

    >>> anchor("W012")
    '<a id="W012"></a>\\n'
    """
    return f'<a id="{name}"></a>\n'


def escaped(text: str) -> str:
    r"""A text in a cell of a table in Markdown.

    >>> escaped("a|b <c> *d*")
    'a\\|b &lt;c&gt; \\*d\\*'
    """
    text = text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    for sign in "\\|*_`[]$":
        text = text.replace(sign, f"\\{sign}")
    return " ".join(text.split())


def code(text: str) -> str:
    """A word of the program in Markdown, within a table as well.

    >>> code("a|b")
    '`a\\\\|b`'
    """
    return f"`{text}`".replace("|", "\\|")
