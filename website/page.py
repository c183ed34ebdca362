"""Page of the site as a text for Sphinx."""

from __future__ import annotations

from typing import NamedTuple

KINDS = ("start", "cookbook", "how-to", "reference", "api", "gallery", "messages", "sources")


class Page(NamedTuple):
    """Page of the site."""

    kind: str
    """One of `KINDS`."""
    name: str
    """Path in the site without suffix, such as `how-to/sweep`."""
    text: str
    """Markdown or reStructuredText."""
    suffix: str = ".md"
    """File suffix of the markup language."""


def anchor(name: str) -> str:
    """Return a target for links, in Markdown.

    >>> anchor("W012")
    '<a id="W012"></a>\\n'
    """
    return f'<a id="{name}"></a>\n'


def escaped(text: str) -> str:
    r"""Return a text escaped for Markdown, also in the cell of a table.

    >>> escaped("a|b <c> *d*")
    'a\\|b &lt;c&gt; \\*d\\*'
    """
    text = text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    for sign in "\\|*_`[]$":
        text = text.replace(sign, f"\\{sign}")
    return " ".join(text.split())


def code(text: str) -> str:
    """Return a text as code in Markdown, also in the cell of a table.

    >>> code("a|b")
    '`a\\\\|b`'
    """
    return f"`{text}`".replace("|", "\\|")
