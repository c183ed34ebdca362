"""Numbers of documents that can be changed: by the paths of a sweep, where they stand in a text."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import NamedTuple

from vstatics.core.elements.drawing import drawing_of
from vstatics.core.elements.keys import with_elements
from vstatics.core.errors import ReadError
from vstatics.core.model.declared_numbers import bare_unit
from vstatics.core.model.keys import CASE
from vstatics.core.model.paths import Keys, by_name, dotted, written
from vstatics.core.model.shape import STRAIGHT, UNIT_OF
from vstatics.core.model.transmission import Transmission
from vstatics.core.readers.documents import case_document
from vstatics.core.readers.named.node_numbers import child
from vstatics.core.readers.named.nodes import Node, Scalar, decode
from vstatics.core.readers.named.written_numbers import NumberSpot, number_spots, with_written
from vstatics.core.readers.named.yaml_nodes import yaml_tree
from vstatics.page.serve.number_fields import PageField
from vstatics.simulation.scenario.keys import SCENARIO
from vstatics.sweep.variants.path_numbers import case_path
from vstatics.sweep.variants.targets import target

_NO_NUMBERS = ("name", "description", "source", "case", "engaged", "gear", "to", "columns", "file")
"""Keys of a scenario below which names stand that may look like numbers."""

_TURNING = {UNIT_OF[measure] for measure in STRAIGHT}
"""Units of what may move straight as well."""
_ABSCISSAS = {"time": "s", "speed": "rad/s", "angle": "rad"}
"""What points of a torque are over, and in what their first numbers are."""

Texts = Mapping[str, bytes]
"""What files hold, by their names."""


class DocumentNumber(NamedTuple):
    """A number that can be changed."""

    field: PageField
    file: str
    keys: Keys
    start: int
    """Place of the number in the text of its file."""


class CaseDocuments(NamedTuple):
    """A case, or a scenario and its case, as they are written; a deck has no numbers to change.

    Parameters
    ----------
    texts : mapping of str to bytes
        The scenario first, if there is one.
    """

    texts: Texts
    numbers: Mapping[str, DocumentNumber]
    """By their paths."""

    @property
    def fields(self) -> list[PageField]:
        """All of them in their order."""
        return [one.field for one in self.numbers.values()]

    def with_changes(self, changes: Mapping[str, float]) -> dict[str, bytes]:
        """The texts with other numbers; only those of files that change.

        Raises
        ------
        ValueError
            If a path names no number here; with what was expected.
        """
        by_file: dict[str, dict[Keys, float]] = {}
        for path, value in changes.items():
            if path not in self.numbers:
                raise ValueError(f"there is no number {path!r} to change")
            one = self.numbers[path]
            by_file.setdefault(one.file, {})[one.keys] = value
        made = {
            file: with_written(self.texts[file], spots_of(file, self.texts[file]), values)
            for file, values in by_file.items()
        }
        return {file: data for file, data in made.items() if data != self.texts[file]}


def documents_of(texts: Texts, case: Transmission) -> CaseDocuments:
    r"""The documents of a case, with all numbers that a field can change.

    Parameters
    ----------
    texts : mapping of str to bytes
        A scenario and then its case, or the case alone.
    case : Transmission
        What was read of it.

    Examples
    --------
    >>> from vstatics import loads
    >>> text = "links: 2\nmechanisms: {D: {first: 1, second: 2, ratio: -78/30}}\ngears: {1: []}"
    >>> made = documents_of({"a.yaml": text.encode()}, loads(text))
    >>> made.fields
    [PageField(path='D.ratio', value=-2.6, unit='', whole=False, same=())]
    >>> made.with_changes({"D.ratio": -3.0})["a.yaml"].decode()
    'links: 2\nmechanisms: {D: {first: 1, second: 2, ratio: -3}}\ngears: {1: []}'
    """
    *scenario, of_case = texts
    found = [one for file in scenario for one in _of_scenario(file, texts[file], case)]
    found += _of_case(of_case, texts[of_case], case)
    numbers: dict[str, DocumentNumber] = {}
    for one in found:  # a name that both documents have is that of the scenario, as in a sweep
        numbers.setdefault(one.field.path, one)
    return CaseDocuments(texts, _with_same(numbers))


def _with_same(numbers: Mapping[str, DocumentNumber]) -> dict[str, DocumentNumber]:
    """Return the numbers, each with the paths of all others at its place in the text."""
    places: dict[tuple[str, int], list[str]] = {}
    for path, number in numbers.items():
        places.setdefault((number.file, number.start), []).append(path)
    return {
        path: number._replace(
            field=number.field._replace(same=tuple(p for p in paths if p != path))
        )
        for path, number in numbers.items()
        for paths in [places[number.file, number.start]]
    }


def spots_of(file: str, data: bytes) -> dict[Keys, NumberSpot]:
    """Where the numbers of a case or of a scenario stand; nothing of a deck or a workbook."""
    try:
        document = case_document(data, file, None)
    except ReadError:
        return {}
    text = document.source.text if document else ""
    return number_spots(text, document.root) if document and text else {}


def _of_scenario(file: str, data: bytes, case: Transmission) -> Iterator[DocumentNumber]:
    """Numbers of a scenario, which a sweep names as they stand there."""
    found = decode(data, file)
    root = yaml_tree(found)
    spots = number_spots(found.source.text, root)
    for keys, spot in spots.items():
        if not any(key in _NO_NUMBERS for key in keys):
            unit = spot.unit or _unit(bare_unit(SCENARIO, keys) or _over(root, keys), keys, case)
            yield DocumentNumber(PageField(written(keys), spot.value, unit), file, keys, spot.start)


def _over(root: Node, keys: Keys) -> str:
    """In what a number is that stands first in a point, by what the points are over."""
    *owner, points, _, place = ("", "", *keys)
    if points != "points" or place != "1":
        return ""
    node: Node | None = root
    for key in [*owner[2:], "over"]:
        node = child(node, key) if node else None
    return _ABSCISSAS.get(node.text, "") if isinstance(node, Scalar) else ""


def _unit(unit: str, keys: Keys, case: Transmission) -> str:
    """A unit, but not where links move straight, or controls are pressures: it may be another."""
    pressed = keys[0] == "controls" and any(one.friction for one in case.shift_elements)
    return "" if (unit in _TURNING and case.masses) or pressed else unit


def _of_case(file: str, data: bytes, case: Transmission) -> Iterator[DocumentNumber]:
    """Numbers of a case that a sweep can vary."""
    shape = with_elements(CASE) if drawing_of(case) else CASE
    for keys, spot in spots_of(file, data).items():
        path = dotted(by_name(keys))
        known = case_path(path, case)
        if known is None and not _is_target(path, case):
            continue
        whole = bool(known and known.part and known.part.kind == "count")
        unit = spot.unit or _unit(bare_unit(shape, keys), keys, case)
        yield DocumentNumber(PageField(path, spot.value, unit, whole), file, keys, spot.start)


def _is_target(path: str, case: Transmission) -> bool:
    try:
        target(path, case)
    except ReadError:
        return False
    return True
