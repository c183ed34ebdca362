"""Numbers in the documents of a case, with paths as in a sweep and positions in the text."""

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
"""Keys of a scenario for names or references, even if their values look like numbers."""

_TURNING = {UNIT_OF[measure] for measure in STRAIGHT}
"""Units of rotation, which would be wrong for links that move straight."""
_ABSCISSAS = {"time": "s", "speed": "rad/s", "angle": "rad"}
"""Unit of the abscissa of torque points, by the value of the key `over`."""

Texts = Mapping[str, bytes]
"""Contents of files, by file name."""


class DocumentNumber(NamedTuple):
    """Number in a document that can be changed on the page."""

    field: PageField
    file: str
    keys: Keys
    start: int
    """Offset of the number in the text of the file, from 0."""


class CaseDocuments(NamedTuple):
    """Documents of a case, or of a scenario and its case. A deck has no numbers to change.

    Parameters
    ----------
    texts : mapping of str to bytes
        Contents of the files by name, with a scenario before its case.
    """

    texts: Texts
    numbers: Mapping[str, DocumentNumber]
    """Numbers that can be changed, by path."""

    @property
    def fields(self) -> list[PageField]:
        """Fields of all numbers that can be changed, in document order."""
        return [number.field for number in self.numbers.values()]

    def with_changes(self, changes: Mapping[str, float]) -> dict[str, bytes]:
        """Return the new contents of files in which numbers change, by file name.

        Raises
        ------
        ValueError
            If a path does not name a number of the documents, or a value is not valid there.
        """
        by_file: dict[str, dict[Keys, float]] = {}
        for path, value in changes.items():
            if path not in self.numbers:
                raise ValueError(f"there is no number {path!r} to change")
            number = self.numbers[path]
            by_file.setdefault(number.file, {})[number.keys] = value
        new_texts = {
            file: with_written(self.texts[file], spots_of(file, self.texts[file]), values)
            for file, values in by_file.items()
        }
        return {file: data for file, data in new_texts.items() if data != self.texts[file]}


def documents_of(texts: Texts, case: Transmission) -> CaseDocuments:
    r"""Return the documents of a case, with all numbers that can be changed on the page.

    Parameters
    ----------
    texts : mapping of str to bytes
        Contents of the files by name, with a scenario before its case.
    case : Transmission
        Case that was read from these texts.

    Examples
    --------
    >>> from vstatics import loads
    >>> text = "links: 2\nmechanisms: {D: {first: 1, second: 2, ratio: -78/30}}\ngears: {1: []}"
    >>> documents = documents_of({"a.yaml": text.encode()}, loads(text))
    >>> documents.fields
    [PageField(path='D.ratio', value=-2.6, unit='', whole=False, same=())]
    >>> documents.with_changes({"D.ratio": -3.0})["a.yaml"].decode()
    'links: 2\nmechanisms: {D: {first: 1, second: 2, ratio: -3}}\ngears: {1: []}'
    """
    *scenario, of_case = texts
    candidates = [number for file in scenario for number in _of_scenario(file, texts[file], case)]
    candidates += _of_case(of_case, texts[of_case], case)
    numbers: dict[str, DocumentNumber] = {}
    # If scenario and case both have a number at the path, the scenario's is meant, as in a sweep.
    for number in candidates:
        numbers.setdefault(number.field.path, number)
    return CaseDocuments(texts, _with_same(numbers))


def _with_same(numbers: Mapping[str, DocumentNumber]) -> dict[str, DocumentNumber]:
    """Add to each number the paths of numbers that are aliases of the same text."""
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
    """Return the numbers in the text of a case or scenario. Decks and workbooks have none."""
    try:
        document = case_document(data, file, None)
    except ReadError:
        return {}
    text = document.source.text if document else ""
    return number_spots(text, document.root) if document and text else {}


def _of_scenario(file: str, data: bytes, case: Transmission) -> Iterator[DocumentNumber]:
    """Yield the numbers of a scenario that can change, with paths as in a sweep."""
    text = decode(data, file)
    root = yaml_tree(text)
    spots = number_spots(text.source.text, root)
    for keys, spot in spots.items():
        if not any(key in _NO_NUMBERS for key in keys):
            unit = spot.unit or _unit(bare_unit(SCENARIO, keys) or _over(root, keys), keys, case)
            yield DocumentNumber(PageField(written(keys), spot.value, unit), file, keys, spot.start)


def _over(root: Node, keys: Keys) -> str:
    """Return the unit of the abscissa of a torque point, which the key `over` determines."""
    *owner_keys, points, _, place = ("", "", *keys)
    if points != "points" or place != "1":
        return ""
    node: Node | None = root
    for key in [*owner_keys[2:], "over"]:
        node = child(node, key) if node else None
    return _ABSCISSAS.get(node.text, "") if isinstance(node, Scalar) else ""


def _unit(unit: str, keys: Keys, case: Transmission) -> str:
    """Return a unit, or "" if uncertain: links can move straight, and controls can be pressures."""
    pressed = keys[0] == "controls" and any(element.friction for element in case.shift_elements)
    return "" if (unit in _TURNING and case.masses) or pressed else unit


def _of_case(file: str, data: bytes, case: Transmission) -> Iterator[DocumentNumber]:
    """Yield the numbers of a case that can change: those that a sweep can vary."""
    shape = with_elements(CASE) if drawing_of(case) else CASE
    for keys, spot in spots_of(file, data).items():
        path = dotted(by_name(keys))
        number = case_path(path, case)
        if number is None and not _is_target(path, case):
            continue
        whole = bool(number and number.part and number.part.kind == "count")
        unit = spot.unit or _unit(bare_unit(shape, keys), keys, case)
        yield DocumentNumber(PageField(path, spot.value, unit, whole), file, keys, spot.start)


def _is_target(path: str, case: Transmission) -> bool:
    try:
        target(path, case)
    except ReadError:
        return False
    return True
