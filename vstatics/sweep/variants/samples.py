"""Samples of numbers by Sobol's sequence, Latin hypercubes or pseudo-random numbers."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import lru_cache
from importlib.util import find_spec
from threading import Lock
from typing import Any, Literal, get_args

import numpy as np

from vstatics.core.errors import CaseError, Problem
from vstatics.core.numerics.arrays import Floats
from vstatics.core.suggestions import nearest
from vstatics.sweep.variants.numbered import checked_targets, empty_block
from vstatics.sweep.variants.variation import MOST, DrawnNumbers, Span, Values, Variation

Method = Literal["sobol", "lhs", "random"]
METHODS: tuple[Method, ...] = get_args(Method)

SOBOL_BITS = 30
SOBOL_TARGETS = 21201
_TABLE_BITS = 16

Words = np.ndarray[Any, np.dtype[np.uint32]]

_latin_lock = Lock()


class Sample:
    """Variants that are drawn from ranges, distributions or lists of values.

    Equal seeds give equal variants, in whichever blocks they are requested. With `sobol` or
    `random`, a larger sample begins with the smaller sample; with `lhs`, it does not.

    Parameters
    ----------
    variations : iterable of Variation
        Varied numbers and their values; at least one number.
    count : int
        Number of variants.
    method : {"sobol", "lhs", "random"}
        `sobol`: Sobol's sequence, scrambled as in scipy, up to 2**30 variants, most even if their
        number is a power of 2. `lhs`: scipy's Latin hypercube; every process calculates all of it
        with about 25 bytes per value, and stores 8. `random`: generator PCG64.
    seed : int
        Seed of the generator, 0 or more.

    Raises
    ------
    ReadError
        If a number is varied twice.
    CaseError
        If nothing is varied, the method cannot give this many variants or needs scipy, or the
        seed is below 0.

    Examples
    --------
    >>> from vstatics.sweep.variants.targets import Target
    >>> sample = Sample([Variation(Target("D1.ratio", 0, "ratio"), Span(-3, -2))], 1000, "random")
    >>> sample.block(0, 1000).shape
    (1000, 1)
    >>> bool((sample.block(10, 20) == sample.block(0, 1000)[10:20]).all())
    True
    """

    def __init__(
        self,
        variations: Iterable[Variation],
        count: int,
        method: Method = "sobol",
        seed: int = 0,
    ) -> None:
        variations = list(variations)
        self.targets = checked_targets(variations)
        self.values = tuple(variation.values for variation in variations)
        self.count, self.method, self.seed = count, method, seed
        problems = [Problem("E710", message) for message in _complaints(self)]
        if problems:
            raise CaseError(problems)

    def block(self, start: int, stop: int) -> Floats:
        """Return the numbers of a block of variants; see `Variants`."""
        block = empty_block(self, start, stop)
        if len(block):
            _FILLERS[self.method](block, self, start)
            for column, values in enumerate(self.values):
                block[:, column] = _picked(values, block[:, column])
        return block


def _complaints(sample: Sample) -> Iterator[str]:
    count, method, dimensions = sample.count, sample.method, len(sample.targets)
    if method not in METHODS:
        hint = nearest(str(method), METHODS)
        yield f"read the method `{method}`, expected one of {', '.join(METHODS)}{hint}"
    elif method != "random" and find_spec("scipy") is None:
        yield f"the method `{method}` needs scipy: install it, or use the method `random`"
    if not dimensions:
        yield "nothing is varied, expected a number to sample"
    if not 0 < count <= MOST:
        yield f"read a sample of {count} variants, expected at least 1 and fewer than 2**63"
    elif method == "sobol" and count > 2**SOBOL_BITS:
        most = f"Sobol's sequence has {2**SOBOL_BITS} (2**{SOBOL_BITS})"
        yield f"read a sample of {count} variants, but {most}; use fewer, or the method `random`"
    if method == "sobol" and dimensions > SOBOL_TARGETS:
        most = f"Sobol's sequence has {SOBOL_TARGETS}"
        yield f"{dimensions} numbers are varied, but {most}; use the method `random`"
    if sample.seed < 0:
        yield f"read the seed {sample.seed}, expected 0 or above"


def _picked(values: Values, unit: Floats) -> Floats:
    """Map numbers from the interval [0, 1) to a range, a distribution or a list of values."""
    if isinstance(values, DrawnNumbers):
        return values.quantiles(unit)
    if isinstance(values, Span):
        low, high = values
        drawn: Floats = np.clip((1 - unit) * low + unit * high, low, high)
        return drawn
    indices = (unit * len(values)).astype(np.int64)
    return values[np.minimum(indices, len(values) - 1)]


def _random(block: Floats, sample: Sample, start: int) -> None:
    """Fill a block with pseudo-random numbers, beginning at the variant `start`."""
    bits = np.random.PCG64(sample.seed)
    bits.advance(start * len(sample.targets))
    block[:] = np.random.Generator(bits).random(block.shape)


def _latin(block: Floats, sample: Sample, start: int) -> None:
    with _latin_lock:
        whole = _latin_hypercube(len(sample.targets), sample.count, sample.seed)
    block[:] = whole[start : start + len(block)]


@lru_cache(maxsize=1)
def _latin_hypercube(dimensions: int, count: int, seed: int) -> Floats:
    from scipy.stats import qmc

    try:
        return qmc.LatinHypercube(dimensions, rng=np.random.default_rng(seed)).random(count)
    except MemoryError:
        message = f"a Latin hypercube of {count} variants does not fit into memory: use fewer"
        raise CaseError("E711", f"{message}, or the method `sobol`") from None


def _sobol(block: Floats, sample: Sample, start: int) -> None:
    """Fill a block with points of Sobol's sequence, without calculating earlier points.

    Point n is the exclusive or of point 0 and of a word for each bit that is set in n. This is
    possible because the Gray code of n, which orders the sequence, is linear in these bits.
    """
    stop = start + len(block)
    first, words = _sobol_words(len(sample.targets), sample.seed, (stop - 1).bit_length())
    low_bits = min(_TABLE_BITS, (len(block) - 1).bit_length(), len(words))
    length = 1 << low_bits
    for column in range(block.shape[1]):
        table = _combined(words[:low_bits, column])
        for base in range(start // length * length, stop, length):
            begin, end = max(start, base), min(stop, base + length)
            origin = first[column]
            for bit in range(low_bits, len(words)):
                if base >> bit & 1:
                    origin ^= words[bit, column]
            block[begin - start : end - start, column] = table[begin - base : end - base] ^ origin
    block *= 0.5**SOBOL_BITS


def _combined(words: Words) -> Words:
    """Return the exclusive or of the words that belong to the set bits of each index."""
    table = np.zeros(1 << len(words), dtype=np.uint32)
    for bit, word in enumerate(words):
        table[1 << bit : 2 << bit] = table[: 1 << bit] ^ word
    return table


@lru_cache(maxsize=32)
def _sobol_words(dimensions: int, seed: int, bits: int) -> tuple[Words, Words]:
    """Return point 0, shape (dimensions,), and the word of each bit, shape (bits, dimensions).

    The words follow from the points 1, 2, 4, ... of scipy's sequence, scaled to integers.
    """
    from scipy.stats import qmc

    engine = qmc.Sobol(dimensions, rng=np.random.default_rng(seed))
    points = [engine.random(1)]
    for bit in range(bits):
        engine.fast_forward((1 << bit) - engine.num_generated)
        points.append(engine.random(1))
    whole = (np.concatenate(points) * 2.0**SOBOL_BITS).astype(np.uint32)
    return whole[0], whole[1:] ^ whole[0]


_FILLERS: dict[Method, Callable[[Floats, Sample, int], None]] = {
    "sobol": _sobol,
    "lhs": _latin,
    "random": _random,
}
