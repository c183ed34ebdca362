"""Nodes that are built value by value, from several cells."""

from __future__ import annotations

from vstatics.core.readers.named.nodes import DocumentText, Listing, Mapping, Node, Scalar
from vstatics.core.readers.workbook.sheets import Part


class GrownNode:
    """Mapping or list under construction, located at the first cell."""

    def __init__(self, line: int, column: int) -> None:
        self.line, self.column = line, column
        self.entries: list[tuple[Part, Scalar, GrownNode | Node]] = []
        self._values: dict[Part, GrownNode | Node] = {}
        """Value of each key; of several values for a key, the first."""

    def below(self, part: Part) -> GrownNode | Node | None:
        """Return the value under a key or item number; None without a value."""
        return self._values.get(part)

    def add(self, part: Part, value: GrownNode | Node) -> None:
        """Add a value under a key or item number."""
        key = Scalar(str(part), value.line, value.column, plain=False)  # a name is never null
        self.entries.append((part, key, value))
        self._values.setdefault(part, value)

    def node(self, document: DocumentText) -> Node:
        """Return the finished node."""
        values = [
            (part, key, value.node(document) if isinstance(value, GrownNode) else value)
            for part, key, value in self.entries
        ]
        numbers = [part for part, _, _ in values if isinstance(part, int)]
        if not numbers:
            return Mapping([(key, value) for _, key, value in values], self.line, self.column)
        if len(numbers) < len(values) or sorted(numbers) != [*range(1, len(values) + 1)]:
            document.stop(
                f"items {', '.join(str(part) for part, _, _ in values)}, expected 1 to the last",
                self.line,
                self.column,
            )
        values.sort(key=lambda item: item[0])
        return Listing([value for _, _, value in values], self.line, self.column)


def moved(node: Node, line: int, column: int) -> Node:
    """Return a copy of a tree in which all nodes have the same place."""
    if isinstance(node, Scalar):
        return node._replace(line=line, column=column)
    if isinstance(node, Listing):
        return Listing([moved(item, line, column) for item in node.items], line, column)
    entries = [
        (key._replace(line=line, column=column), moved(value, line, column))
        for key, value in node.entries
    ]
    return Mapping(entries, line, column)
