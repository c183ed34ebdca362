"""Where the parts of a model stand in a document, and what is wrong there."""

from __future__ import annotations

from typing import NamedTuple

from vstatics.errors import Path, Problem, path_text
from vstatics.readers.named.nodes import Found, Node, shown


class Spot(NamedTuple):
    """A place in the model and in the document: what is said about it starts with `label`."""

    path: Path
    label: str
    node: Node

    def key(self, part: str | int, key: str, node: Node) -> Spot:
        """The value under a key, which is `part` to the model."""
        return Spot((*self.path, part), _joined(self.label, shown(key)), node)

    def item(self, part: str | int, number: int, node: Node) -> Spot:
        """An item of a list by its number from 1, which is `part` to the model."""
        return Spot((*self.path, part), f"{self.label}[{number}]", node)


class Spots:
    """The spots of a document by their paths.

    Attributes
    ----------
    unreadable : list of Path
        Where something could not be read, and a stand-in is in the model.
    """

    def __init__(self, found: Found) -> None:
        """Start without any."""
        self.found = found
        self.unreadable: list[Path] = []
        self._spots: dict[Path, Spot] = {}

    def keep(self, spot: Spot, node: Node | None = None) -> None:
        """Remember a spot, or `node` as its place; the first one of a path counts."""
        self._spots.setdefault(spot.path, spot._replace(node=node or spot.node))

    def complain(self, spot: Spot, message: str, node: Node | None = None) -> None:
        """Say what is wrong at a spot, or at a `node` of it."""
        at = node or spot.node
        text = f"{spot.label}: {message}" if spot.label else message
        self.found.add(text, at.line, at.column, spot.path)

    def refuse(self, spot: Spot, message: str) -> None:
        """Say why a spot cannot be read."""
        self.complain(spot, message)
        self.unreadable.append(spot.path)

    def tell(self, path: Path, message: str) -> None:
        """Say what is wrong with a part of the model, of which that need say nothing then."""
        self.found.problems.append(self.locate(Problem(message, path)))
        self.unreadable.append(path)

    def missing(self, spot: Spot, key: str) -> None:
        """Say that a key is missing; where it would stand is where its record starts."""
        self.complain(self._spots[spot.path], f"`{key}` is missing")
        self.unreadable.append((*spot.path, key))

    def locate(self, problem: Problem) -> Problem:
        """Give a problem of the model its place, and its label before the message."""
        if problem.place is not None:
            return problem
        known = problem.path
        while known not in self._spots:
            known = known[:-1]  # the root is always there
        spot = self._spots[known]
        label = _joined(spot.label, path_text(problem.path[len(known) :]))
        return problem._replace(
            message=f"{label}: {problem.message}" if label else problem.message,
            place=self.found.source.place(spot.node.line, spot.node.column),
        )


def _joined(label: str, part: str) -> str:
    dot = "." if label and part and not part.startswith("[") else ""
    return f"{label}{dot}{part}"
