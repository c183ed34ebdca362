"""What to say of a sign or a word that does not belong where it stands."""

from __future__ import annotations

from vstatics.errors import quoted
from vstatics.readers.expressions.excerpt import Excerpt

ELSEWHERE = {
    "&&": "and",
    "&": "and",
    "||": "or",
    "|": "or",
    "!": "not",
    "^": "**",
    "//": "/",
    "=": "==",
    "<>": "!=",
    "≤": "<=",
    "≥": ">=",
    "≠": "!=",
    "−": "-",
    "–": "-",
    "×": "*",
    "·": "*",
    "÷": "/",
}
"""Signs of other languages, and how they are written here."""
PYTHON = ("lambda", "for", "in", "if", "else", "is", "await", "async", "yield", "from", "import")
"""Words that ask for more than this language has."""


def no_operator(source: Excerpt, at: int, read: str, before: str) -> str:
    """What to say of something that was read behind an operand.

    >>> no_operator(Excerpt("1 & 2", "--where"), 2, "&", "1")
    'read `&`, expected `and`'
    """
    if read == ",":
        return "read `,`, expected an operator, or an end"
    if read == ")":
        return "read `)`, but no bracket is open"
    if source.has("[", at):
        return "read `[`, but rows and gears belong to a table, such as speeds[:,1]"
    if read in ELSEWHERE and read != "!":
        return f"read `{read}`, expected `{ELSEWHERE[read]}`"
    if read in PYTHON:
        return f"read `{read}`, which this language does not have"
    shown = quoted(read or source.text[at])
    expected = "expected an operator such as `+`, `<` or `and`, or an end"
    return f"read {shown} behind {quoted(before)}, {expected}"


def no_operand(source: Excerpt, at: int, read: str, before: str, operands: str) -> str:
    """What to say of something that was read where one of the operands is expected.

    >>> no_operand(Excerpt("1 + * 2", "--where"), 4, "*", "+", "a number")
    'read `*` behind `+`, expected a number'
    """
    if ELSEWHERE.get(read) in ("-", "not"):
        return f"read `{read}`, expected `{ELSEWHERE[read]}`"
    if source.has("[", at):
        return "read `[`, expected a table before it, such as speeds[:,1]"
    behind = f" behind {quoted(before)}" if before else ""
    shown = f"read {quoted(read or source.text[at])}" if at < source.end else "the text ends"
    return f"{shown if source.part.strip() else 'read nothing'}{behind}, expected {operands}"
