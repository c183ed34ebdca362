"""Detection of the encoding of a Russian text without byte order mark.

For each encoding, a score is calculated from letters, pairs of letters, capitals and signs.
"""

from __future__ import annotations

import re
from functools import lru_cache
from itertools import pairwise

ENCODINGS = ("cp1251", "cp866", "koi8-r")
"""Encodings of Windows, DOS and Unix; of equal scores, the first counts."""

_FOLLOWERS = (
    "абвгежзйклмнпстчя беоы ваеиклносхы гио даеилноу егджзйклмнпрстхч жеим завм ибезйлмнрстя йл "
    "каеилосту лаеиоьюя маеио надеинотуы обвгдежзйклмнпрстчщ пеор раеиосуь секлоптя таеиорсыь "
    "удрю фа хо це чаеинт шаеи ще ыех эт"
)
"""Frequent pairs of Russian letters: a first letter, followed by the letters that often follow."""
_PAIRS = frozenset(word[0] + letter for word in _FOLLOWERS.split() for letter in word[1:])
_RUSSIAN = frozenset("абвгдежзийклмнопрстуфхцчшщъыьэюя" + "ё")
_OTHERS = frozenset("іїєґў")
"""Letters of Ukrainian and Belarusian."""
_SOUNDED = frozenset("аеёиоуыэюя")
_SIGNS = "«»“”„–—…№°±·²×µ\xa0"
_BOXES = frozenset(map(chr, range(0x2500, 0x25A0)))
"""Box-drawing characters and blocks, used in tables of DOS programs."""
_THRICE = re.compile(r"(.)\1\1")
_WORD = re.compile(r"[^\x00-\x7f]+")


def in_each_encoding(data: bytes) -> list[str]:
    """Return a text that is not UTF-8, decoded by all encodings, the most likely first.

    >>> in_each_encoding("Коробка МЗКТ".encode("cp866"))[0]
    'Коробка МЗКТ'
    >>> in_each_encoding("НЕЙТРАЛЬ".encode("koi8-r"))[0]
    'НЕЙТРАЛЬ'
    """
    candidates = list[str]()
    for encoding in ENCODINGS:
        try:
            candidates.append(data.decode(encoding))
        except UnicodeDecodeError:  # CP1251 does not define one of the bytes
            continue
    return sorted(
        candidates,
        # Each different word counts once.
        key=lambda text: sum(map(_word_score, set(_WORD.findall(text)))),
        reverse=True,
    )


@lru_cache(maxsize=20000)
def _word_score(word: str) -> float:
    """Return the score of a word; a larger score means a more likely word."""
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
    # Capitals are at the beginning of words, or follow other capitals.
    score -= 1.5 * sum(a.islower() and b.isupper() for a, b in pairwise(word))
    if word.islower() and not _SOUNDED.intersection(small):
        score -= 1.5  # every Russian word has a vowel, except acronyms such as МЗКТ in capitals
    return score
