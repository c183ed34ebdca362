"""What a clutch that is dumped must fulfil; problems with paths."""

from __future__ import annotations

import math
from collections.abc import Iterator

from vstatics.errors import Path, Problem
from vstatics.model.clutch_dump import NEEDED
from vstatics.model.fields import TransmissionFields
from vstatics.model.part_checks import called, of_link


def of_dump(case: TransmissionFields) -> Iterator[Problem]:
    """Links that there are, each once, and numbers above 0."""
    dump = case.dump
    if dump is None:
        return
    seen: dict[int, str] = {}
    for name, links in dump.masses.items():
        if not links and name in NEEDED:
            yield Problem("there is no link, expected one at least", ("dump", name))
        for number, link in enumerate(links, 1):
            path: Path = ("dump", name, number)
            yield from of_link(link, path, case.own_links, lowest=1)
            if link in seen:
                message = f"link {called(case, link)} is in {seen[link]} already"
                yield Problem(f"{message}, expected each link once", path)
            seen.setdefault(link, name)
    if dump.to is not None:
        yield from of_link(dump.to, ("dump", "to"), case.own_links, lowest=1)
    for name in ("M_C0", "omega1", "M_phi", "E"):
        value = getattr(dump, name)
        if value is not None and not (value > 0 and (value < math.inf or name == "M_phi")):
            yield Problem(f"read {value:g}, expected a number above 0", ("dump", name))
