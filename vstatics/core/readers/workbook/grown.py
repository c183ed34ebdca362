"""Nodes that are put together value by value, each of another cell."""

from __future__ import annotations

from vstatics.core.readers.named.nodes import Found, Listing, Mapping, Node, Scalar
from vstatics.core.readers.workbook.sheets import Part


class GrownNode:
    """A mapping or a list that is being put together; its place is that of its first cell."""

    def __init__(self, line: int, column: int) -> None:
        self.line, self.column = line, column
        self.entries: list[tuple[Part, Scalar, GrownNode | Node]] = []
        self._values: dict[Part, GrownNode | Node] = {}
        """The first one of each key."""

    def below(self, part: Part) -> GrownNode | Node | None:
        """What stands at a key or a number."""
        return self._values.get(part)

    def add(self, part: Part, value: GrownNode | Node) -> None:
        """Put a value at a key or a number."""
        key = Scalar(str(part), value.line, value.column, plain=False)  # a name, whatever it is
        self.entries.append((part, key, value))
        self._values.setdefault(part, value)

    def node(self, found: Found) -> Node:
        """The node that it has become."""
        made = [
            (part, key, value.node(found) if isinstance(value, GrownNode) else value)
            for part, key, value in self.entries
        ]
        numbers = [part for part, _, _ in made if isinstance(part, int)]
        if not numbers:
            return Mapping([(key, value) for _, key, value in made], self.line, self.column)
        if len(numbers) < len(made) or sorted(numbers) != [*range(1, len(made) + 1)]:
            message = f"items {', '.join(str(part) for part, _, _ in made)}, expected 1 to the last"
            found.stop(message, self.line, self.column)
        made.sort(key=lambda one: one[0])
        return Listing([value for _, _, value in made], self.line, self.column)


def moved(node: Node, line: int, column: int) -> Node:
    """A tree all of which stands at one place."""
    if isinstance(node, Scalar):
        return node._replace(line=line, column=column)
    if isinstance(node, Listing):
        return Listing([moved(one, line, column) for one in node.items], line, column)
    entries = [
        (key._replace(line=line, column=column), moved(value, line, column))
        for key, value in node.entries
    ]
    return Mapping(entries, line, column)
