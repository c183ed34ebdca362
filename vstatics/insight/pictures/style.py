"""How pictures look."""

from __future__ import annotations

from dataclasses import dataclass

from vstatics.results import Language


@dataclass(frozen=True)
class Style:
    """Colours and language of a picture.

    Parameters
    ----------
    ink, paper, accent, muted : str
        Colours of lines and text, of the background, of what is engaged, of what is idle.
    lang : {"en", "ru"}
        Of the words that do not come from the case.
    """

    ink: str = "#1c2733"
    paper: str = "#ffffff"
    accent: str = "#c8391f"
    muted: str = "#a9b2ba"
    lang: Language = "en"
