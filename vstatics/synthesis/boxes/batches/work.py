"""The work of a search for boxes, piece by piece: what workers do, what is finished and kept."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from hashlib import sha256
from itertools import islice
from typing import Any, NamedTuple

from vstatics.core.errors import CaseError
from vstatics.core.extras import build
from vstatics.core.jobs.finished_pieces import FinishedPieces
from vstatics.core.jobs.piece_file import Account, piece_bytes, read_segments, write_piece
from vstatics.synthesis.boxes.batches.found import FoundPiece, found_in
from vstatics.synthesis.boxes.box import BoxSearch, FoundBox
from vstatics.synthesis.boxes.figures.measured import ALIKE, MeasuredBox, measured
from vstatics.synthesis.structures.scheme import SetScheme

MOST_FOUND = 1_000_000
"""So many boxes are kept, for the sake of memory."""
MOST_MEASURED = 50_000
"""So many have their figures made."""
BOXES_AT_ONCE = 20
"""So many boxes a worker measures at once."""
SEARCHED, GIVEN_UP = "searched", "given up"
"""What is counted in a piece."""


class BoxWork(NamedTuple):
    """What a worker needs to know."""

    search: BoxSearch
    efficiency: float
    pieces: int = 1
    """So many it is cut into."""
    weights: Mapping[str, float] = ALIKE
    """Of gears in the mean of the drag."""

    def describe(self, item: object) -> str:
        """A piece, boxes that are measured, or files of one with a name, in words."""
        if isinstance(item, int):
            return f"piece {item} of the search"
        return str(getattr(item, "name", "figures of boxes"))


def find(work: BoxWork, piece: int) -> FoundPiece:
    """The boxes of a piece."""
    return found_in(work.search, piece, work.pieces)


def measure(work: BoxWork, boxes: Sequence[FoundBox]) -> list[MeasuredBox]:
    """The figures of some boxes."""
    return [measured(work.search, box, work.efficiency, work.weights) for box in boxes]


def portions(boxes: Iterable[FoundBox]) -> Iterator[tuple[FoundBox, ...]]:
    """Boxes as workers get them."""
    coming = iter(boxes)
    while portion := tuple(islice(coming, BOXES_AT_ONCE)):
        yield portion


def description(search: BoxSearch, pieces: int) -> dict[str, Any]:
    """What a search is, for its directory of pieces and for whoever looks into that."""
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
"""What is named otherwise where it is asked for."""


class SearchedPieces:
    """The pieces that are done: in a directory, where they outlive the process, or in memory."""

    def __init__(self, count: int, store: FinishedPieces | None = None) -> None:
        """Take up what the store has; it is opened before."""
        self.count = count
        self._store = store
        self._accounts: dict[int, Account] = {} if store is None else dict(store.accounts)
        self._lines: dict[int, bytes] = {}

    @property
    def pending(self) -> Iterator[int]:
        """The pieces that are not done; there may be millions."""
        return (piece for piece in range(self.count) if piece not in self._accounts)

    @property
    def done(self) -> int:
        """How many are done."""
        return len(self._accounts)

    @property
    def searched(self) -> int:
        """So many boxes were looked at."""
        return sum(account.counts[SEARCHED] for account in self._accounts.values())

    @property
    def given_up(self) -> int:
        """So many sets of elements may be boxes, too."""
        return sum(account.counts.get(GIVEN_UP, 0) for account in self._accounts.values())

    @property
    def found(self) -> int:
        """So many of them have the ratios."""
        return sum(account.rows for account in self._accounts.values())

    def take(self, piece: int, found: FoundPiece) -> None:
        """Keep a piece.

        Raises
        ------
        CaseError
            If there are too many boxes.
        OSError
            If it can't be written.
        """
        lines = box_lines(found.boxes)
        counts = {SEARCHED: int(found.searched), GIVEN_UP: found.given_up}
        work = "" if self._store is None else self._store.work
        account, buffers = piece_bytes(piece, len(found.boxes), counts, [lines], work=work)
        if self._store is None:
            self._lines[piece] = lines
        else:
            write_piece(self._store.directory, piece, buffers)
        self._accounts[piece] = account
        check_most(self.found, MOST_FOUND)

    def boxes(self) -> Iterator[FoundBox]:
        """All boxes, piece by piece in their order, whichever came first."""
        for piece in sorted(self._accounts):
            yield from boxes_of_lines(self._text(piece))

    def _text(self, piece: int) -> bytes:
        if self._store is None:
            return self._lines[piece]
        return b"".join(read_segments(self._store.directory, self._accounts[piece]))


def check_most(count: int, most: int) -> None:
    """Refuse more boxes than anybody can look at.

    Raises
    ------
    CaseError
    """
    if count > most:
        message = f"more than {most} boxes are found: expected a smaller --tolerance, more --ratios"
        raise CaseError("E808", f"{message}, or less choice by --brakes and --clutches")


def box_lines(boxes: Iterable[FoundBox]) -> bytes:
    """A line for each box.

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
        f"{json.dumps(one, separators=(',', ':'), default=int)}\n".encode() for one in plain
    )


def boxes_of_lines(lines: bytes) -> Iterator[FoundBox]:
    """The boxes of such lines."""
    for line in lines.splitlines():
        code, held, first, last, elements, ratios, gears, error = json.loads(line)
        yield FoundBox(
            SetScheme.of_code(code),
            held,
            first,
            last,
            tuple((one, other) for one, other in elements),
            tuple(ratios),
            tuple(map(tuple, gears)),
            error,
        )
