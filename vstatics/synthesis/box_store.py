"""Found boxes as lines of JSON, which a search that is taken up reads again."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator

from vstatics.synthesis.box import FoundBox
from vstatics.synthesis.scheme import SetScheme


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
