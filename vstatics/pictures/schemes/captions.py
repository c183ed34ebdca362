"""Captions of a picture of a scheme: title, tooltips of components, and the gear shown."""

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
    """Captions of a picture of a scheme."""

    state: SchemeState
    titles: Titles
    name: str
    """Title of the picture, with the name of the case."""


def told_of(
    results: Results,
    scheme: Scheme,
    style: Style,
    gears: Sequence[int],
    *,
    subject: str,
) -> SchemeTold:
    """Return the captions of a picture without a gear, or of a gear by number from 1.

    Raises
    ------
    CaseError
        If several gears are given.
    """
    if len(gears) > 1:
        raise CaseError("E410", "this picture shows one gear at a time: name it with --gear")
    state, texts, shown, gear = SchemeState(), [subject], None, None
    for gear in gears:
        shown = state_of(results, gear)
        state = scheme_state(scheme, shown)
        texts += [gear_title(shown.gear.name, style)]
        texts += [fault(message, style) for message in shown.faults]
    titles = titles_of(results, scheme, style, gear, shown)
    return SchemeTold(state, titles, title(results.case, ", ".join(texts)))
