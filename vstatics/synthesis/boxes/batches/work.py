"""Jobs of the workers in a search for gearboxes, and the store of finished pieces."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from hashlib import sha256
from itertools import islice
from typing import Any, NamedTuple

from vstatics.core.errors import CaseError
from vstatics.core.extras import build
from vstatics.core.jobs.finished_pieces import FinishedPieces
from vstatics.core.jobs.piece_file import piece_bytes, read_segments, write_piece
from vstatics.synthesis.boxes.batches.found import FoundPiece, found_in
from vstatics.synthesis.boxes.box import BoxSearch, FoundBox
from vstatics.synthesis.boxes.figures.measured import ALIKE, MeasuredBox, measured
from vstatics.synthesis.structures.scheme import SetScheme

MOST_FOUND_BOXES = 1_000_000
"""Largest number of gearboxes that are kept in memory."""
MOST_MEASURED = 50_000
"""Largest number of gearboxes whose figures (loss, torque, ...) are calculated."""
BOXES_AT_ONCE = 20
"""Number of gearboxes whose figures a worker calculates at once."""
SEARCHED, GIVEN_UP = "searched", "given up"
"""Names of the counts that are stored with a piece."""


class BoxWork(NamedTuple):
    """Data that all jobs of a worker share."""

    search: BoxSearch
    efficiency: float
    pieces: int = 1
    """Number of pieces of the search."""
    weights: Mapping[str, float] = ALIKE
    """Weights of gears in the mean drag, by the name of the gear."""

    def describe(self, item: object) -> str:
        """Return the name of a job for messages, such as "piece 3 of the search"."""
        if isinstance(item, int):
            return f"piece {item} of the search"
        return str(getattr(item, "name", "figures of boxes"))


def find(work: BoxWork, piece: int) -> FoundPiece:
    """Search a piece for gearboxes."""
    return found_in(work.search, piece, work.pieces)


def measure(work: BoxWork, boxes: Sequence[FoundBox]) -> list[MeasuredBox]:
    """Calculate the characteristic numbers (figures) of gearboxes."""
    return [measured(work.search, box, work.efficiency, work.weights) for box in boxes]


def portions(boxes: Iterable[FoundBox]) -> Iterator[tuple[FoundBox, ...]]:
    """Yield gearboxes in groups, each for a job of a worker."""
    coming = iter(boxes)
    while portion := tuple(islice(coming, BOXES_AT_ONCE)):
        yield portion


def description(search: BoxSearch, pieces: int) -> dict[str, Any]:
    """Return a description of a search, stored with the pieces for human readers."""
    asked = {**search._asdict(), "targets": [*search.targets], "bounds": [*search.bounds]}
    asked["tolerances"] = [*search.tolerances]
    asked["brake_counts"] = search.brake_counts and [*search.brake_counts]
    if search.kept is not None:
        asked["kept"] = {**search.kept._asdict(), "scheme": search.kept.scheme.code}
    named = {_OPTIONS.get(name, name): value for name, value in asked.items()}
    text = json.dumps([named, pieces, build()])
    return {
        "what": "unfinished search of vstatics; the same command with --resume goes on",
        "build": build(),
        "fingerprint": sha256(text.encode()).hexdigest(),
        "pieces": pieces,
        **named,
    }


_OPTIONS = {
    "targets": "ratios",
    "own_input": "own-input",
    "own_output": "own-output",
    "brake_counts": "brakes",
    "sequence": "gears",
    "singly": "single",
}
"""Names of options on the command line, by the field of `BoxSearch`, where the names differ."""


class SearchedPieces:
    """Finished pieces of a search, in a directory that outlives the process, or in memory."""

    def __init__(self, count: int, store: FinishedPieces | None = None) -> None:
        """Begin with the finished pieces of an open store, if any."""
        self.count = count
        self._store = store
        self._accounts = {} if store is None else dict(store.accounts)
        self._lines: dict[int, bytes] = {}

    @property
    def pending(self) -> Iterator[int]:
        """Numbers of the unfinished pieces; an iterator, because there can be millions."""
        return (piece for piece in range(self.count) if piece not in self._accounts)

    @property
    def done(self) -> int:
        """Number of finished pieces."""
        return len(self._accounts)

    @property
    def searched(self) -> int:
        """Number of examined gearboxes in the finished pieces."""
        return sum(account.counts[SEARCHED] for account in self._accounts.values())

    @property
    def given_up(self) -> int:
        """Number of sets of shift elements that could give gearboxes but were given up."""
        return sum(account.counts.get(GIVEN_UP, 0) for account in self._accounts.values())

    @property
    def found(self) -> int:
        """Number of gearboxes with the wanted ratios in the finished pieces."""
        return sum(account.rows for account in self._accounts.values())

    def take(self, piece: int, result: FoundPiece) -> None:
        """Store a finished piece.

        Raises
        ------
        CaseError
            If there are too many boxes.
        OSError
            If the piece cannot be written.
        """
        lines = box_lines(result.boxes)
        counts = {SEARCHED: int(result.searched), GIVEN_UP: result.given_up}
        work = "" if self._store is None else self._store.work
        account, buffers = piece_bytes(piece, len(result.boxes), counts, [lines], work=work)
        if self._store is None:
            self._lines[piece] = lines
        else:
            write_piece(self._store.directory, piece, buffers)
        self._accounts[piece] = account
        check_most(self.found, MOST_FOUND_BOXES)

    def boxes(self) -> Iterator[FoundBox]:
        """Yield all gearboxes in the order of the pieces, whichever piece finished first."""
        for piece in sorted(self._accounts):
            yield from boxes_of_lines(self._text(piece))

    def _text(self, piece: int) -> bytes:
        if self._store is None:
            return self._lines[piece]
        return b"".join(read_segments(self._store.directory, self._accounts[piece]))


def check_most(count: int, most: int) -> None:
    """Refuse a number of gearboxes larger than `most`.

    Raises
    ------
    CaseError
    """
    if count > most:
        raise CaseError(
            "E808",
            f"more than {most} gearboxes are found: expected a smaller --tolerance, more --ratios"
            ", or fewer --brakes and --clutches",
        )


def box_lines(boxes: Iterable[FoundBox]) -> bytes:
    """Return gearboxes as text with a line of JSON for each.

    Examples
    --------
    >>> box = FoundBox(SetScheme.of_code("0-1-2"), None, 0, 1, ((2, -1),), (-2.0,), ((0,),), 0.0)
    >>> box_lines([box])
    b'["0-1-2",null,0,1,[[2,-1]],[-2.0],[[0]],0.0]\\n'
    >>> list(boxes_of_lines(box_lines([box]))) == [box]
    True
    """
    plain = ([box.scheme.code, *box[1:]] for box in boxes)
    return b"".join(
        f"{json.dumps(values, separators=(',', ':'), default=int)}\n".encode() for values in plain
    )


def boxes_of_lines(lines: bytes) -> Iterator[FoundBox]:
    """Yield the gearboxes from text with a line of JSON for each."""
    for line in lines.splitlines():
        code, held, first, last, elements, ratios, gears, error = json.loads(line)
        yield FoundBox(
            SetScheme.of_code(code),
            held,
            first,
            last,
            tuple((first_end, second_end) for first_end, second_end in elements),
            tuple(ratios),
            tuple(map(tuple, gears)),
            error,
        )
