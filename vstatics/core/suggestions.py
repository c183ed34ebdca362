"""Suggestions for mistyped names: similar known names, and letters of another script."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from vstatics.core.errors import quoted, spoken
from vstatics.core.groups import grouped
from vstatics.core.messages.catalogue import causes_of_allowable

_LEAST_PART = 4
"""Smallest number of letters of a word for which names that contain the word are suggested."""


_LATIN = {
    "Cyrillic": ("АВЕКМНОРСТУХІЈЅԚԜаеорсухіјѕ", "ABEKMHOPCTYXIJSQWaeopcyxijs"),
    "Greek": ("ΑΒΕΖΗΙΚΜΝΟΡΤΥΧοιν", "ABEZHIKMNOPTYXoiv"),
}
"""Letters of other scripts, and the Latin letters that look the same."""
_SCRIPTS = {letter: script for script, (letters, _) in _LATIN.items() for letter in letters}
_LOOKS = str.maketrans(dict(pair for pairs in _LATIN.values() for pair in zip(*pairs, strict=True)))


def lookalike(word: str, known: Iterable[str]) -> str:
    """Return a hint with a known word that looks the same but has other characters.

    >>> lookalike("\u0421_1", ["B", "C_1"])
    '; did you mean `C_1`? Letter 1, `\u0421`, is Cyrillic in what was read, but Latin in this name'
    >>> lookalike("Ra\u0308der", ["R\u00e4der"]).partition("? ")[2]
    'It looks the same, but has accents with other codes'
    """
    from unicodedata import normalize  # costs start-up time

    composed = normalize("NFC", word)
    looks = composed.translate(_LOOKS)
    names = ((name, normalize("NFC", name)) for name in known if name != word)
    name, letters = next((pair for pair in names if pair[1].translate(_LOOKS) == looks), ("", ""))
    if not name:
        return ""
    if letters == composed:
        return f"; did you mean `{name}`? It looks the same, but has accents with other codes"
    places = grouped(
        ((_SCRIPTS.get(read, "Latin"), _SCRIPTS.get(meant, "Latin")), place)
        for place, (read, meant) in enumerate(zip(composed, letters, strict=True))
        if read != meant
    )
    said = "; ".join(
        f"{_letters(composed, which)} {read} in what was read, but {meant} in this name"
        for (read, meant), which in places.items()
    )
    return f"; did you mean `{name}`? {said}"


def mixed_letters(word: str) -> str:
    """Return a hint on Cyrillic or Greek letters in a Latin word; empty for a single script.

    >>> mixed_letters("k\u0435g"), mixed_letters("kg"), mixed_letters("\u0442\u043e\u043d")
    ('; letter 2, `\u0435`, is Cyrillic', '', '')
    """
    if not any("a" <= letter.casefold() <= "z" for letter in word):
        return ""
    said = [
        f"{_letters(word, which)} {script}"
        for script, (letters, _) in _LATIN.items()
        if (which := [place for place, letter in enumerate(word) if letter in letters])
    ]
    return "".join(f"; {part[0].lower()}{part[1:]}" for part in said)


def _letters(word: str, places: Sequence[int]) -> str:
    numbers = spoken(str(place + 1) for place in places)
    letters = ", ".join(f"`{word[place]}`" for place in places)
    return (
        f"Letter {numbers}, {letters}, is"
        if len(places) == 1
        else f"Letters {numbers}, {letters}, are"
    )


def nearest(word: str, known: Iterable[str]) -> str:
    """Return a hint with the known word most similar to a mistyped word, or an empty text.

    If known words contain the mistyped word, the shortest of these is suggested.

    >>> nearest("ratoi", ["ratio", "efficiency"]), nearest("eta", ["ratio", "ETA"])
    ('; did you mean `ratio`?', '; did you mean `ETA`?')
    >>> nearest("wilson", ["simpson", "wilson-preselector"])
    '; did you mean `wilson-preselector`?'
    >>> nearest("xyz", ["ratio", "efficiency"]), nearest("closed", ["loss"])
    ('', '')
    """
    import difflib  # costs start-up time

    names = [*known]
    if alike := lookalike(word, names):
        return alike
    words = grouped((name.casefold(), name) for name in names)
    asked = word.casefold()
    longer = [name for name in words if asked in name and len(asked) >= _LEAST_PART]
    matches = sorted(longer, key=len) or difflib.get_close_matches(asked, words, n=1, cutoff=0.62)
    if not matches:
        return ""
    [match] = difflib.get_close_matches(word, words[matches[0]], n=1, cutoff=0)
    return f"; did you mean `{match}`?"


def why_not_allowed(identity: str) -> str:
    """Return the reason why messages with an id cannot be suppressed; empty if allowed.

    >>> why_not_allowed("E234"), why_not_allowed("W999")
    ('`E234` is an error, expected a warning or a note', 'there is no message `W999`')
    """
    allowable = causes_of_allowable()
    if identity in allowable:
        return ""
    if re.fullmatch(r"E\d{3}", identity):
        return f"{quoted(identity)} is an error, expected a warning or a note"
    return f"there is no message {quoted(identity)}{nearest(identity, allowable)}"
