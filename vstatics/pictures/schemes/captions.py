"""What a picture of a scheme says: its state in a gear, its title, what its parts tell."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from vstatics.core.errors import CaseError
from vstatics.core.statics.results import Results
from vstatics.pictures.drawing.gear_state import state_of
from vstatics.pictures.drawing.style import Style
from vstatics.pictures.drawing.words import fault, gear_title, title
from vstatics.pictures.schemes.scheme import Scheme, SchemeState, scheme_state
from vstatics.pictures.schemes.titles import Titles, titles_of


class SchemeTold(NamedTuple):
    """What a picture of a scheme says besides the scheme."""

    state: SchemeState
    titles: Titles
    name: str
    """Of the picture."""
    note: str = ""


def told_of(  # noqa: PLR0913 - what is drawn, and how
    results: Results,
    scheme: Scheme,
    style: Style,
    gears: Sequence[int],
    *,
    subject: str,
    note: str = "",
) -> SchemeTold:
    """What is said of no gear, or of one by its number from 1.

    Raises
    ------
    CaseError
        If there are several gears.
    """
    if len(gears) > 1:
        raise CaseError("E410", "the picture of a scheme shows one gear at a time")
    state, texts, own, gear = SchemeState(), [subject], None, None
    for gear in gears:
        own = state_of(results, gear)
        state = scheme_state(scheme, own)
        texts += [gear_title(own.gear.name, style), *(fault(one, style) for one in own.faults)]
    titles = titles_of(results, scheme, style, gear, own)
    return SchemeTold(state, titles, title(results.case, ", ".join(texts)), note)
