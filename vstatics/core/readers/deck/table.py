"""Declaration of a deck's lists with a value for each part, for the reader and the writer."""

from __future__ import annotations

from vstatics.core.named_tuple import NamedTuple


class DeckList(NamedTuple):
    """List of a deck that contains a value for each part of a kind.

    >>> FIELDS["IAB"].part, FIELDS["IAB"].member, FIELDS["IAB"].size
    ('mechanisms', 'ratio', 'KG')
    """

    part: str
    """Attribute of the model that contains the parts: ``mechanisms``, ``shift_elements`` or
    ``gears``.
    """
    member: str
    """Attribute of a part that contains the value, such as ``ratio``."""
    size: str
    """Name of the field that prescribes the number of values."""
    heading: str
    """Line above the list in a written deck."""
    kind: type[float] = int
    """Type of the values. A list of floats is written on several lines."""


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
"""Lists by name in messages, in the order of a template. Lists for gears are optional."""
