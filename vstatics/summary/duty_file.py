"""A duty cycle as a YAML file: `energy` or `time`, and a share for each gear."""

from __future__ import annotations

from collections.abc import Mapping as MappingOf
from typing import NamedTuple, get_args

from vstatics.errors import CaseError, Place, Problem, ReadError
from vstatics.readers.named import scalars
from vstatics.readers.named.nodes import Found, Mapping, Node, Scalar, decode, shown, what
from vstatics.statics.results import Results
from vstatics.summary.duty import Cycle, Duty, Kind, cycle

KINDS: tuple[Kind, ...] = get_args(Kind)
EXPECTED = "`energy` or `time` with a share for each gear"


class DutyFile(NamedTuple):
    """A duty cycle, and where each of its gears stands."""

    duty: Duty
    file: str
    places: MappingOf[str, Place]

    def of(self, results: Results) -> Cycle:
        """The cycle of a case.

        Raises
        ------
        ReadError
            As `cycle` does, with places.
        """
        try:
            return cycle(results, self.duty)
        except CaseError as error:
            raise ReadError([self._located(problem) for problem in error.problems]) from None

    def _located(self, problem: Problem) -> Problem:
        if not problem.path:
            return problem._replace(place=Place(self.file, 0, 0))
        gear = str(problem.path[0])
        return problem._replace(
            place=self.places[gear], message=f"gear {shown(gear)}: {problem.message}"
        )


def read_duty(data: bytes, file: str) -> DutyFile:
    """Read a duty cycle.

    Parameters
    ----------
    data : bytes
    file : str
        Its name, for messages.

    Raises
    ------
    ReadError
        With every problem and its place.

    Examples
    --------
    >>> read_duty(b'energy: {"1": 1, "2": 3/2}', "duty.yaml").duty
    Duty(kind='energy', shares={'1': 1.0, '2': 1.5})
    """
    from vstatics.readers.named.yaml_nodes import yaml_tree  # yaml costs start-up time

    if not data.strip():
        raise ReadError(
            [Problem(f"the file is empty, expected {EXPECTED}", place=Place(file, 1, 1))]
        )
    found = decode(data, file)
    root = yaml_tree(found)
    if not isinstance(root, Mapping) or len(root.entries) != 1:
        found.stop(f"expected {EXPECTED}, and nothing else", root.line, root.column)
    [(key, node)] = root.entries
    kind = next((kind for kind in KINDS if kind == key.text), None)
    if kind is None:
        hint = found.hint(key.text, KINDS)
        found.stop(f"read `{shown(key.text)}`, expected {EXPECTED}{hint}", key.line, key.column)
    if not isinstance(node, Mapping):
        found.stop(f"read {what(node)}, expected a share for each gear", node.line, node.column)
    shares: dict[str, float] = {}
    for gear, value in node.entries:
        if gear.text in shares:
            found.add(f"gear {shown(gear.text)} is given twice", gear.line, gear.column)
        shares[gear.text] = _share(found, value)
    if found.problems:
        raise ReadError(found.problems)
    places = {gear.text: found.source.place(gear.line, gear.column) for gear, _ in node.entries}
    return DutyFile(Duty(kind, shares), file, places)


def _share(found: Found, node: Node) -> float:
    """A number of 0 or more."""
    try:
        share = scalars.number(node.text) if isinstance(node, Scalar) else -1.0
    except ValueError:
        share = -1.0
    if share < 0:
        found.add(f"read {what(node)}, expected a share of 0 or more", node.line, node.column)
    return share
