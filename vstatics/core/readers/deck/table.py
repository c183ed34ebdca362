"""The lists of a deck whose values each are of a part of the model, for readers and the writer."""

from __future__ import annotations

from typing import NamedTuple


class DeckList(NamedTuple):
    """A list with a value for each part of a kind.

    >>> FIELDS["IAB"].part, FIELDS["IAB"].member, FIELDS["IAB"].size
    ('mechanisms', 'ratio', 'KG')
    """

    part: str
    """The list of the model that the parts are in."""
    member: str
    """What a value is of its part."""
    size: str
    """The field that tells how many values there are."""
    heading: str
    """The line above it in a deck that is written."""
    kind: type[float] = int
    """Of the values; those that are not whole stand in lines of their own."""


FIELDS = {
    "NZF(I,1)": DeckList("shift_elements", "first", "KL", "Shift elements, first links:"),
    "NZF(I,2)": DeckList(
        "shift_elements", "second", "KL", "Shift elements, second links (0 is the housing):"
    ),
    "NZD(I,1)": DeckList("mechanisms", "first", "KG", "Mechanisms, first links (suns):"),
    "NZD(I,2)": DeckList("mechanisms", "second", "KG", "Mechanisms, second links (rings):"),
    "NZD(I,3)": DeckList(
        "mechanisms", "third", "KG", "Mechanisms, third links (carriers; 0 if there is none):"
    ),
    "IAB": DeckList("mechanisms", "ratio", "KG", "Ratios, third link held:", float),
    "ETAI": DeckList("mechanisms", "efficiency", "KG", "Efficiencies, third link held:", float),
    "INP(I)": DeckList("gears", "input", "NP", "Input link in each gear (0: that of the case):"),
    "IOUT(I)": DeckList("gears", "output", "NP", "Output link in each gear (0: that of the case):"),
}
"""By the names that messages have for them, in the order of the template; gears may do without."""
