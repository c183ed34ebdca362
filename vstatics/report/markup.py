"""HTML from small parts: whatever is not markup already is escaped."""

from __future__ import annotations

from html import escape


class Markup(str):
    """Text that is HTML already."""

    __slots__ = ()


VOID = {"meta"}
"""Elements that have no end."""


def tag(name: str, /, *children: str, **attributes: object) -> Markup:
    """An element; children that are no `Markup` are escaped.

    Parameters
    ----------
    **attributes
        False leaves an attribute out, True gives its name alone. ``class_`` is ``class``,
        other underscores are hyphens.

    Examples
    --------
    >>> tag("td", "a < b", class_="name", data_value=0.5, hidden=True, id=False)
    '<td class="name" data-value="0.5" hidden>a &lt; b</td>'
    >>> tag("p", tag("b", "&"))
    '<p><b>&amp;</b></p>'
    """
    given = "".join(_attribute(key, value) for key, value in attributes.items())
    start = f"<{name}{given}>"
    return Markup(start) if name in VOID else Markup(f"{start}{joined(*children)}</{name}>")


def _attribute(key: str, value: object) -> str:
    if value is False:
        return ""
    name = key.removesuffix("_").replace("_", "-")
    return f" {name}" if value is True else f' {name}="{escape(str(value))}"'


def joined(*children: str) -> Markup:
    """Parts one after the other.

    >>> joined(tag("b", "1"), " < 2")
    '<b>1</b> &lt; 2'
    """
    return Markup("".join(one if isinstance(one, Markup) else escape(one) for one in children))


def figure(name: str, picture: Markup) -> Markup:
    """A picture with its name; a wide one can be scrolled."""
    scrolled = tag("div", picture, class_="scroll", tabindex=0, role="region", aria_label=name)
    return tag("figure", tag("figcaption", name), scrolled)
