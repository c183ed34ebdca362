"""Reasons why a text is not YAML, in words for readers who do not know the parser."""

from __future__ import annotations

import yaml

_BRACKETS = {"flow sequence": ("list", "]"), "flow mapping": ("mapping", "}")}
"""Names of the parser for values in brackets, with plain names and closing brackets."""


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
    mark, begin = error.problem_mark, error.context_mark
    place = f"line {begin.line + 1}, column {begin.column + 1}" if begin else ""
    index = mark.index if mark else len(text)
    is_first = not text[text.rfind("\n", 0, index) + 1 : index].strip()
    for kind, (name, bracket) in _BRACKETS.items():
        if kind in context and place:
            return f"the {name} that begins on {place} is not closed, expected `,` or `{bracket}`"
    if problem.startswith("mapping values are not allowed"):
        return "read a second `: `; write a text with a colon in quotes, and check the indentation"
    if "that cannot start any token" in problem and text[index : index + 1].strip():
        return f"read `{text[index]}`, with which no text begins; write the text in quotes"
    if context.endswith("block mapping") and begin and is_first:
        return (
            f"wrong indentation here or above: the mapping that begins on {place} continues with "
            f"a key in column {begin.column + 1}"
        )
    if context.endswith(("block collection", "block sequence")) and begin and is_first:
        return (
            f"wrong indentation here or above: the list that begins on {place} continues with "
            f"`- ` in column {begin.column + 1}"
        )
    if "quoted scalar" in context and "end of stream" in problem:
        return f"the quotation mark on {place} is not closed"
    return ", ".join(part for part in (context, problem) if part)
