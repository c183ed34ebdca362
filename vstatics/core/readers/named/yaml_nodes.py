"""YAML text -> tree of nodes, from the events of the parser.

Events are read one at a time, so that unlimited nesting or aliases are rejected early. YAML tags
have no effect: only texts, lists and mappings are created.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

import yaml

from vstatics.core.errors import Problem
from vstatics.core.readers.named.nodes import (
    DASH_HINT,
    UNKNOWN_KEY,
    DocumentText,
    Listing,
    Mapping,
    Node,
    Scalar,
    shown,
)

_BRACKETS = {"flow sequence": ("list", "]"), "flow mapping": ("mapping", "}")}
"""Words of the parser for a value in brackets, with plain words and the closing bracket."""
_BLOCKS = {
    "block mapping": ("mapping", "a key"),
    "block collection": ("list", "`- `"),
    "block sequence": ("list", "`- `"),
}
"""Words of the parser for a value without brackets, with plain words and the kind of entry."""
MOST_VALUES = 200_000
"""Maximum number of values of a document, if all aliases are expanded."""

_READ_AHEAD = "exceeded maximum nesting depth"
"""Message of libyaml about more than 1000 levels, which can occur before any event."""

_NO_COLON = "could not find expected ':'"
"""Message of the parsers about a key without colon, which they notice only on a later line."""

_UNPRINTABLE = re.compile("[^\t\n\r -~\x85\xa0-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
_TEXT_WITH_BRACKETS = re.compile(r"[^\s,:'\"{}[\]]\[")
"""Pattern of a text with `[`, which YAML reads as the start of an inner list."""
_SPACED_RATIO = re.compile(r"(-?\d*\.?\d+)[ \t]+:[ \t]*(\d*\.?\d+)")
"""Pattern of a ratio with blanks around the colon, which YAML reads as the end of a key."""
_COMMENT_HINT = "; ` #` begins a comment, so write a text that contains ` #` in quotes"
_CUT = re.compile(r" +#\d")
"""Pattern after a text that probably continues: a number follows the sign of a comment."""
_STANDARD = "tag:yaml.org,2002:"
_TAGS = {
    Scalar: {"!", *(_STANDARD + kind for kind in ("str", "int", "float", "bool", "null"))},
    Listing: {"!", _STANDARD + "seq"},
    Mapping: {"!", _STANDARD + "map"},
}


def yaml_tree(document: DocumentText) -> Node:
    r"""Return the tree of nodes of a text that contains a single YAML document.

    Raises
    ------
    ReadError
        If the text is not YAML, does not contain exactly one document, or is nested too deeply.

    Examples
    --------
    >>> from vstatics.core.readers.reading import Source
    >>> text = "name: Box #3\nsource: 'P #2' #1\ninput: a # 1\noutput: b #6P\nratio: 3 #4"
    >>> document = DocumentText(Source("box.yaml", text))
    >>> _ = yaml_tree(document)
    >>> [problem.place[1:3] for problem in document.warnings]
    [(1, 7), (4, 9)]
    """
    unprintable = _UNPRINTABLE.search(document.text)
    if unprintable:
        document.stop(
            f"U+{ord(unprintable[0]):04X}, a character that YAML does not allow",
            *document.place(unprintable.start()),
        )
    return _Builder(document, getattr(yaml, "CSafeLoader", yaml.SafeLoader)).root()


_NO_MAPPING = "expected a mapping, or a list of mappings, after the merge key `<<`"


class _Builder:
    """Builder of nodes from parser events. It also counts the values that aliases repeat."""

    def __init__(self, document: DocumentText, loader: Any) -> None:
        self.document = document
        self.events: Iterator[yaml.Event] = yaml.parse(document.text, Loader=loader)
        self.anchors: dict[str, tuple[Node | None, int]] = {}
        """Node of each anchor (None while incomplete), and its number of values."""
        self.values = 0
        self.last = (1, 1)

    def root(self) -> Node:
        self.next()
        if isinstance(self.next(), yaml.StreamEndEvent):
            self.document.stop("the file is empty, expected a case", 1, 1)
        root = self.node(self.next(), 1)
        self.next()
        if not isinstance(self.next(), yaml.StreamEndEvent):
            self.document.stop(
                "a second document starts here, expected a single document in a file", *self.last
            )
        return root

    def next(self) -> yaml.Event:
        try:
            event = next(self.events)
        except yaml.MarkedYAMLError as error:
            if error.problem == _READ_AHEAD:
                # raises an error for excessive nesting
                _Builder(self.document, yaml.SafeLoader).root()
            mark = error.problem_mark or error.context_mark
            if error.problem == _NO_COLON:
                mark = error.context_mark
            place = self.document.place(mark.index) if mark else self.last
            reason = reason_of(error, self.document.text)
            if (
                mark
                and mark.index
                and _TEXT_WITH_BRACKETS.match(self.document.text, mark.index - 1)
            ):
                reason += "; write a name with brackets in quotes within a list, such as 'ratio[1]'"
            reason += self._spaced_ratio(mark.index) if mark else ""
            if mark and self.document.text[mark.index : mark.index + 1] == "\t":
                reason = "read a tab, expected blanks: no tab indents a line"
            self.document.stop(f"not YAML: {reason}", *place)
        except (yaml.YAMLError, ValueError, OverflowError) as error:  # such as "\U00110000"
            self.document.stop(f"not YAML: {error}", *self.last)
        if event.start_mark:
            self.last = self.document.place(event.start_mark.index)
        return event

    def _spaced_ratio(self, at: int) -> str:
        """Return advice if the text at an offset is a ratio with blanks; empty for other texts."""
        for ratio in _SPACED_RATIO.finditer(self.document.text, max(at - 40, 0), at + 40):
            if ratio.start() <= at <= ratio.end():
                first, second = ratio.groups()
                number = first if float(second) == 1 else f"{first}/{second}"
                return f"; write a ratio in quotes, '{ratio[0]}', or as {number}"
        return ""

    def node(self, event: yaml.Event, depth: int) -> Node:
        line, column = self.last
        self.document.check_depth(depth, line, column)
        if isinstance(event, yaml.AliasEvent):
            return self.alias(event)
        anchor = getattr(event, "anchor", None)
        before = self.values
        self.values += 1
        if anchor:
            self.anchors[anchor] = None, 0
        node: Node
        match event:
            case yaml.SequenceStartEvent():
                node = Listing(list(self.items(depth)), line, column)
            case yaml.MappingStartEvent():
                node = Mapping(self.merged([*self.entries(depth)]), line, column)
            case _:
                node = self.scalar(event, line, column)
        tag = getattr(event, "tag", None)
        if tag and tag not in _TAGS[type(node)]:
            message = f"tag {shown(tag.replace(_STANDARD, '!!'))} is not accepted, expected no tag"
            self.document.add(message, line, column, identity="E108")
        if anchor:
            self.anchors[anchor] = node, self.values - before
        return node

    def items(self, depth: int) -> Iterator[Node]:
        while not isinstance(event := self.next(), yaml.SequenceEndEvent):
            yield self.node(event, depth + 1)

    def entries(self, depth: int) -> Iterator[tuple[Scalar, Node]]:
        while not isinstance(event := self.next(), yaml.MappingEndEvent):
            key = self.node(event, depth + 1)
            if not isinstance(key, Scalar):
                self.document.stop(
                    "a key that is a list or a mapping, expected text", key.line, key.column
                )
            yield key, self.node(self.next(), depth + 1)

    def merged(self, entries: list[tuple[Scalar, Node]]) -> list[tuple[Scalar, Node]]:
        """Return entries with the mappings after merge keys `<<`, whose known keys are left out."""
        names = {key.text for key, _ in entries}
        merged: list[tuple[Scalar, Node]] = []
        for key, value in entries:
            if not (key.plain and key.text == "<<"):
                merged.append((key, value))
                continue
            for source in value.items if isinstance(value, Listing) else [value]:
                if isinstance(source, Mapping):
                    merged += (entry for entry in source.entries if entry[0].text not in names)
                    names |= {name.text for name, _ in source.entries}
                else:
                    self.document.add(_NO_MAPPING, key.line, key.column, identity=UNKNOWN_KEY)
        return merged

    def scalar(self, event: Any, line: int, column: int) -> Scalar:
        self.document.check_characters(event.value, line, column)
        plain = not event.style and event.tag not in ("!", _STANDARD + "str")
        text = event.value
        if plain and _CUT.match(self.document.text, event.end_mark.index) and text[:1].isalpha():
            message = f"read '{shown(text)}'{_COMMENT_HINT}"
            place = self.document.source.place(line, column)
            self.document.warnings.append(Problem("W104", message, (), place))
        return Scalar(text, line, column, plain)

    def alias(self, event: yaml.AliasEvent) -> Node:
        anchor = event.anchor or ""
        name = shown(anchor)
        known = self.anchors.get(anchor)
        if known is None:
            hint = self.document.hint(anchor, self.anchors)
            self.document.stop(f"alias *{name} has no anchor before it{hint}", *self.last)
        node, size = known
        if node is None:
            self.document.stop(f"alias *{name} is inside the part that it repeats", *self.last)
        self.values += size
        if self.values > MOST_VALUES:
            self.document.stop(
                f"alias *{name} makes more than {MOST_VALUES} values of this document", *self.last
            )
        return node


def reason_of(error: yaml.MarkedYAMLError, text: str) -> str:
    """Return the reason for a parser error in a text, with advice if possible.

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
    if problem == _NO_COLON:
        line = text[begin.index :].partition("\n")[0] if begin else ""
        hint = DASH_HINT * bool(re.match(r"-\w", line)) + _COMMENT_HINT * (" #" in line)
        return f"expected a key with a colon and a blank, such as `low: [C1, B1]`{hint}"
    if problem.startswith("mapping values are not allowed"):
        return "read a second `: `; write a text with a colon in quotes, and check the indentation"
    if "that cannot start any token" in problem and text[index : index + 1].strip():
        return f"read `{text[index]}`, with which no text begins; write the text in quotes"
    return _of_part(context, begin, text, index) or raw if begin else raw


def _of_part(context: str, begin: yaml.Mark, text: str, index: int) -> str:
    """Return the reason for an error within a list, mapping or quotation; empty if unknown."""
    place = f"line {begin.line + 1}, column {begin.column + 1}"
    for kind, (name, bracket) in _BRACKETS.items():
        if kind in context:
            hint = _COMMENT_HINT * (" #" in text[begin.index : index])
            open_part = f"the {name} that begins on {place} is not closed"
            return f"{open_part}, expected `,` or `{bracket}`{hint}"
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
