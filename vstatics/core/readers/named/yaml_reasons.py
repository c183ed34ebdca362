"""Reasons why a text is not YAML, in words for readers who do not know the parser."""

from __future__ import annotations

import yaml

_BRACKETS = {"flow sequence": ("list", "]"), "flow mapping": ("mapping", "}")}
"""Names of the parser for values in brackets, with plain names and closing brackets."""
_BLOCKS = {
    "block mapping": ("mapping", "a key"),
    "block collection": ("list", "`- `"),
    "block sequence": ("list", "`- `"),
}
"""Names of the parser for values without brackets, with plain names and their entries."""


def reason_of(error: yaml.MarkedYAMLError, text: str) -> str:
    """Return the reason of an error of the parser in a text, with advice where it is known.

    >>> def reason(text):
    ...     try:
    ...         list(yaml.parse(text))
    ...     except yaml.MarkedYAMLError as error:
    ...         print(reason_of(error, text))
    >>> reason("a: [b, c")
    the list that begins on line 1, column 4 is not closed, expected `,` or `]`
    >>> reason("a: b: c")
    read a second `: `; write a text with a colon in quotes, and check the indentation
    >>> reason("a: @b")
    read `@`, with which no text begins; write the text in quotes
    """
    context, problem = error.context or "", error.problem or ""
    begin = error.context_mark
    index = error.problem_mark.index if error.problem_mark else len(text)
    raw = ", ".join(part for part in (context, problem) if part)
    if problem.startswith("mapping values are not allowed"):
        return "read a second `: `; write a text with a colon in quotes, and check the indentation"
    if "that cannot start any token" in problem and text[index : index + 1].strip():
        return f"read `{text[index]}`, with which no text begins; write the text in quotes"
    return _of_part(context, begin, text, index) or raw if begin else raw


def _of_part(context: str, begin: yaml.Mark, text: str, index: int) -> str:
    """Return the reason of an error at an index within a part of a text; empty if unknown."""
    place = f"line {begin.line + 1}, column {begin.column + 1}"
    for kind, (name, bracket) in _BRACKETS.items():
        if kind in context:
            return f"the {name} that begins on {place} is not closed, expected `,` or `{bracket}`"
    if "quoted scalar" in context and index >= len(text):
        return f"the quotation mark on {place} is not closed"
    is_first = not text[text.rfind("\n", 0, index) + 1 : index].strip()
    for kind, (name, item) in _BLOCKS.items():
        if context.endswith(kind) and is_first:
            return (
                f"wrong indentation here or above: the {name} that begins on {place} continues "
                f"with {item} in column {begin.column + 1}"
            )
    return ""
