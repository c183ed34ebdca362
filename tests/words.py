"""Words that readers stumble over, and the texts of the program in which they are forbidden."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import click

from tests.rooms import PACKAGE, modules, nodes
from vstatics.core.cli import main

FORBIDDEN = {
    "told, tells": r"\b(?:tell|tells|told|telling)\b",
    "is no (there is no is fine)": r"(?<!there )\b(?:is|are|was|were) no (?!longer|more|less|better|worse|need|way)\w+",
    "in place of": r"\bin place of\b",
    "element alone, not a gear set, shift element or finite element": (
        r"(?<!shift[ -])(?<!gear )(?<!finite )\belements?\b(?!:)"
    ),
}
_CODE = re.compile(r"``[^`]+``|`[^`\n]+`")
_OPTION = re.compile(r"--[a-z][\w-]*")
_FENCE = re.compile(r"^[ \t]*```.*?^[ \t]*```[ \t]*$", re.MULTILINE | re.DOTALL)
_LINK = re.compile(r"\]\([^)]*\)")
_HEADS_OF_EXAMPLES = re.compile(r"^\s*Examples?:.*?(?=^\S|\n\s*\n|\Z)", re.MULTILINE | re.DOTALL)
_SPEAKS = {"Problem", "of_file", "CaseError", "ReadError", "Message", "Said", "Doubt"} | {
    *("ValueError", "UnitError", "UnknownNameError", "BadParameter", "UsageError", "NoFormula"),
    *("complain", "refuse", "stop", "error", "tell", "no_result", "of_result"),
}
"""Functions and methods that take the text of a message."""
_NAMES = {"message", "text", "fault", "expected", "reason", "advice", "why", "hint", "cure", "what"}
"""Variables that hold a part of a message."""


def stumbles(text: str) -> list[str]:
    """Return forbidden words of a text with some words around them; code does not count.

    >>> stumbles("what is missing is told, `told` is not")
    ['told, tells: what is missing is told, CODE is not']
    >>> stumbles("3 shift elements and 2 gear sets, no longer elements")
    ['element alone, not a gear set, shift element or finite element: ear sets, no longer elements']
    """
    plain = _OPTION.sub("OPTION", _CODE.sub("CODE", _LINK.sub("]", " ".join(text.split()))))
    return [
        f"{name}: {plain[max(0, found.start() - 20) : found.end() + 20].strip()}"
        for name, pattern in FORBIDDEN.items()
        for found in re.finditer(pattern, plain, re.IGNORECASE)
    ]


def messages(room: str) -> Iterator[tuple[str, str]]:
    """Yield place and text of all parts of messages in the modules of the core or an annex."""
    for name, file in modules().items():
        if name.split(".")[1:2] != [room]:
            continue
        for node in nodes(file):
            for part in _parts_of_messages(node):
                for literal in ast.walk(part):
                    text = _text(literal)
                    if " " in text:  # others are keys and names
                        yield f"{name}:{part.lineno}", text


def _parts_of_messages(node: ast.AST) -> list[ast.expr]:
    if isinstance(node, ast.Call):
        function = node.func
        called = function.attr if isinstance(function, ast.Attribute) else ""
        called = function.id if isinstance(function, ast.Name) else called
        return node.args if called in _SPEAKS else []
    if isinstance(node, ast.Assign | ast.AugAssign):
        targets = node.targets if isinstance(node, ast.Assign) else [node.target]
        named = {target.id for target in targets if isinstance(target, ast.Name)}
        return [node.value] if named & _NAMES else []
    return []


def _text(literal: ast.AST) -> str:
    """Return the text of a literal, with a word for each value of an f-string."""
    if isinstance(literal, ast.Constant):
        return literal.value if isinstance(literal.value, str) else ""
    if not isinstance(literal, ast.JoinedStr):
        return ""
    return "".join(
        str(part.value) if isinstance(part, ast.Constant) else "X" for part in literal.values
    )


def explanations(file: str) -> Iterator[tuple[str, str]]:
    """Yield id and text of the explanations in a file of the catalogue, by its stem."""
    text = (PACKAGE / f"core/messages/causes/{file}.txt").read_text("utf-8")
    for block in text.split("\n\n"):
        identity, _, rest = block.strip().partition("\n")
        yield identity, rest


def helps(command: click.Command, words: tuple[str, ...] = ()) -> Iterator[tuple[str, str]]:
    """Yield the words and the help of a command and of its sub-commands, without examples."""
    context = click.Context(
        command, info_name=" ".join(words), max_content_width=200, **main.context_settings
    )
    yield " ".join(words), _HEADS_OF_EXAMPLES.sub("", command.get_help(context))
    if isinstance(command, click.Group):
        for name in command.list_commands(context):
            inner = command.get_command(context, name)
            if inner is not None:
                yield from helps(inner, (*words, name))


def prose(document: Path) -> str:
    """Return the text of a document without its blocks of code."""
    return _FENCE.sub("", document.read_text("utf-8"))
