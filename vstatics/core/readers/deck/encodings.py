"""Detection of the encoding of a Russian text.

The score of an encoding depends on letters, pairs of letters, capitals and signs of the decoded
text.
"""

from __future__ import annotations

import re
from functools import lru_cache
from itertools import pairwise

ENCODINGS = ("cp1251", "cp866", "koi8-r")
"""Encodings of Windows, DOS and Unix. The first is chosen if scores are equal."""

_FOLLOWERS = (
    "абвгежзйклмнпстчя беоы ваеиклносхы гио даеилноу егджзйклмнпрстхч жеим завм ибезйлмнрстя йл "
    "каеилосту лаеиоьюя маеио надеинотуы обвгдежзйклмнпрстчщ пеор раеиосуь секлоптя таеиорсыь "
    "удрю фа хо це чаеинт шаеи ще ыех эт"
)
"""Frequent pairs of Russian letters: a first letter, then the letters that often follow it."""
_PAIRS = frozenset(word[0] + letter for word in _FOLLOWERS.split() for letter in word[1:])
_RUSSIAN = frozenset("абвгдежзийклмнопрстуфхцчшщъыьэюя" + "ё")
_OTHERS = frozenset("іїєґў")
"""Letters of Ukrainian and Belarusian that Russian does not have."""
_SOUNDED = frozenset("аеёиоуыэюя")
_SIGNS = "«»“”„–—…№°±·²×µ\xa0"
_BOXES = frozenset(map(chr, range(0x2500, 0x25A0)))
"""Box-drawing characters and blocks, used in tables of DOS programs."""
_THRICE = re.compile(r"(.)\1\1")
_WORD = re.compile(r"[^\x00-\x7f]+")


def in_each_encoding(data: bytes) -> list[str]:
    """Return the decoded text for each possible encoding other than UTF-8, most likely first.

    >>> in_each_encoding("Коробка МЗКТ".encode("cp866"))[0]
    'Коробка МЗКТ'
    >>> in_each_encoding("НЕЙТРАЛЬ".encode("koi8-r"))[0]
    'НЕЙТРАЛЬ'
    """
    candidates = list[str]()
    for encoding in ENCODINGS:
        try:
            candidates.append(data.decode(encoding))
        except UnicodeDecodeError:  # a byte is undefined in CP1251
            continue
    return sorted(
        candidates,
        key=lambda text: sum(map(_word_score, set(_WORD.findall(text)))),  # all different words
        reverse=True,
    )


@lru_cache(maxsize=20000)
def _word_score(word: str) -> float:
    """Return the score of a word; more likely words have larger scores."""
    small = word.lower()
    letters = [letter in _RUSSIAN or letter in _OTHERS for letter in small]
    if not any(letters):
        return -sum(letter not in _SIGNS and letter not in _BOXES for letter in small)
    core = small.strip(_SIGNS)
    score = sum(letter in _RUSSIAN or -2.0 * (letter not in _OTHERS) for letter in core)
    for first, second in pairwise(core):
        if first in _RUSSIAN and second in _RUSSIAN:
            score += 1.5 if first + second in _PAIRS else -1.0
    score -= 3.0 * len(_THRICE.findall(core))
    # In Russian, capitals occur only at the beginning of a word or after other capitals.
    score -= 1.5 * sum(a.islower() and b.isupper() for a, b in pairwise(word))
    if word.islower() and not _SOUNDED.intersection(small):
        score -= 1.5  # every Russian word has a vowel; acronyms such as МЗКТ are in capitals
    return score
