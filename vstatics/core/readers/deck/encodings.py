"""Which of the encodings of Russian a text is in: the one in which its words look like words."""

from __future__ import annotations

import re
from functools import lru_cache
from itertools import pairwise

ENCODINGS = ("cp1251", "cp866", "koi8-r")
"""Those of Windows, DOS and Unix, the likeliest first where a text does not tell."""

_FOLLOWERS = (
    "абвгежзйклмнпстчя беоы ваеиклносхы гио даеилноу егджзйклмнпрстхч жеим завм ибезйлмнрстя йл "
    "каеилосту лаеиоьюя маеио надеинотуы обвгдежзйклмнпрстчщ пеор раеиосуь секлоптя таеиорсыь "
    "удрю фа хо це чаеинт шаеи ще ыех эт"
)
"""A letter of Russian, and behind it those that often follow it."""
_PAIRS = frozenset(word[0] + one for word in _FOLLOWERS.split() for one in word[1:])
_RUSSIAN = frozenset("абвгдежзийклмнопрстуфхцчшщъыьэюя" + "ё")
_OTHERS = frozenset("іїєґў")
"""Of Ukrainian and Belarusian."""
_SOUNDED = frozenset("аеёиоуыэюя")
_SIGNS = "«»“”„–—…№°±·²×µ\xa0"
_BOXES = frozenset(map(chr, range(0x2500, 0x25A0)))
"""Lines and blocks, of which tables were drawn."""
_THRICE = re.compile(r"(.)\1\1")
_WORD = re.compile(r"[^\x00-\x7f]+")


def in_each_encoding(data: bytes) -> list[str]:
    """A text that is no UTF-8, as it reads in each encoding that has all its bytes, best first.

    >>> in_each_encoding("Коробка МЗКТ".encode("cp866"))[0]
    'Коробка МЗКТ'
    >>> in_each_encoding("НЕЙТРАЛЬ".encode("koi8-r"))[0]
    'НЕЙТРАЛЬ'
    """
    found = list[str]()
    for encoding in ENCODINGS:
        try:
            found.append(data.decode(encoding))
        except UnicodeDecodeError:  # CP1251 lacks one byte
            continue
    return sorted(found, key=_likeness, reverse=True)


def _likeness(text: str) -> float:
    """How much its words look like words, each counted once."""
    return sum(map(_of_word, set(_WORD.findall(text))))


@lru_cache(maxsize=20000)
def _of_word(word: str) -> float:
    """By its letters, pairs of them, capitals and signs; the larger the likelier."""
    small = word.lower()
    letters = [one in _RUSSIAN or one in _OTHERS for one in small]
    if not any(letters):
        return -sum(one not in _SIGNS and one not in _BOXES for one in small)
    core = small.strip(_SIGNS)
    score = sum(one in _RUSSIAN or -2.0 * (one not in _OTHERS) for one in core)
    for first, second in pairwise(core):
        if first in _RUSSIAN and second in _RUSSIAN:
            score += 1.5 if first + second in _PAIRS else -1.0
    score -= 3.0 * len(_THRICE.findall(core))
    # a capital stands first or among capitals
    score -= 1.5 * sum(a.islower() and b.isupper() for a, b in pairwise(word))
    if word.islower() and not _SOUNDED.intersection(small):
        score -= 1.5  # as no word has; МЗКТ is one of capitals, and so is the brake Т
    return score
