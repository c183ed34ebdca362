"""Table of shipped gearboxes, from which `known` names found gearboxes.

Reading all cases takes longer than most searches, so `make known` writes the table to a file,
`known.jsonl`.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator

from vstatics.core.examples import example, example_files
from vstatics.core.jobs.files import replace
from vstatics.synthesis.boxes.figures.built import built_box
from vstatics.synthesis.boxes.figures.known import KnownBox
from vstatics.synthesis.boxes.least_form import least_forms


def shipped_boxes() -> Iterator[KnownBox]:
    """Yield each shipped case that is a gearbox, once for each form of `least_forms`."""
    for name in example_files():
        if "/" in name:  # a scenario, not a case
            continue
        case = example(name)
        box = built_box(case)
        for form in least_forms(box) if box else ():
            yield KnownBox(name, len(case.shift_elements) - len(form.elements), form)


def table() -> str:
    """Return the text of `known.jsonl`."""
    return "".join(known.line() for known in shipped_boxes())


if __name__ == "__main__":
    replace(sys.argv[1], table().encode())
