"""Matrix exponential at many times; the lower rows of the matrix are chains of derivatives."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import takewhile

import numpy as np

from vstatics.core.numerics.arrays import Floats, Integers, largest

_NONE = np.zeros(0)
_TERMS = 22
"""Number of terms of the exponential series, which also limits the length of chains."""
_COLUMNS = 256
"""Number of state vectors multiplied at once, which limits the memory."""


class Exponential:
    """Matrix exponential ``exp(A s)`` for s from 0 to 1, by scaling and squaring.

    Parameters
    ----------
    matrix : ndarray
        Matrix A.
    nodes : ndarray, optional
        Values of s at which `nodes` keeps the exponential for repeated use.
    rows : int, optional
        Number of leading rows that are calculated. The rows below must be 0 except for numbers
        right above the diagonal, as in chains of derivatives. This saves most of the work.

    Examples
    --------
    >>> decay = Exponential(np.array([[-3.0]]))
    >>> decay.at(np.array([0.0, 1.0]))[:, 0, 0].round(6)
    array([1.      , 0.049787])
    """

    def __init__(self, matrix: Floats, nodes: Floats = _NONE, rows: int | None = None) -> None:
        norm = largest(np.abs(matrix).sum(axis=0))
        self.halvings = max(0, int(np.ceil(np.log2(norm / 2.0)))) if norm > 2.0 else 0
        self.step = matrix / 2.0**self.halvings
        self.dense = len(matrix) if rows is None else rows
        orders = np.arange(len(matrix)) - np.arange(self.dense, len(matrix))[:, None]
        self.doubling = 2.0 ** np.clip(orders, 0, _TERMS)
        """Factors by which the entries of the lower rows grow when s doubles."""
        unit = np.eye(len(matrix))
        self.series = np.array([*_terms(unit[: self.dense], self.step, self.dense, _TERMS)])
        chains = self.step[self.dense :, self.dense :]
        chained = sum(
            takewhile(np.ndarray.any, _terms(np.eye(len(chains)), chains, 0, _TERMS)),
            np.zeros_like(chains),
        )
        lower = np.hstack([unit[self.dense :, : self.dense], chained])
        # Small terms come first, because rounding would lose them after large terms.
        self.halved = [np.vstack([self.series[::-1].sum(axis=0), lower])]
        """Exponentials for s = 1, 1/2, 1/4, ..., down to the step of the series."""
        for _ in range(self.halvings):
            self.halved.insert(0, self._squared(self.halved[0]))
        self.doubled = [self.halved[0]]
        """Exponentials for s = 1, 2, 4, ..."""
        self.nodes = self.at(nodes)
        """First rows of the exponential at the nodes, shape (nodes, rows, size)."""

    def _squared(self, exponential: Floats) -> Floats:
        first = exponential[: self.dense] @ exponential
        return np.vstack([first, exponential[self.dense :] * self.doubling])

    def at(self, parts: Floats) -> Floats:
        """Return the first rows of ``exp(A s)`` for all s in `parts`, shape (parts, rows, size)."""
        steps, powers = self._split(parts)
        exponentials = np.tensordot(powers.T, self.series, 1)
        for halved, far in steps:
            exponentials[far] = exponentials[far] @ halved
        return exponentials

    def at_nodes(self, starts: Floats) -> Floats:
        """Return the first rows of ``exp(A s) x`` at the nodes, for each column x of `starts`.

        The result has the shape (rows, columns * nodes).
        """
        nodes, rows, size = self.nodes.shape
        columns = starts.shape[1]
        inner = self.nodes.reshape(nodes * rows, size) @ starts
        inner = inner.reshape(nodes, rows, columns).transpose(1, 2, 0)
        return np.ascontiguousarray(inner).reshape(rows, columns * nodes)

    def moved(self, parts: Floats, states: Floats) -> Floats:
        """Return first rows of ``exp(A s) x`` for paired s in `parts` and columns x of `states`."""
        steps, powers = self._split(parts)
        result = states.copy()
        for halved, far in steps:
            result[:, far] = halved @ result[:, far]
        blocks = [slice(n, n + _COLUMNS) for n in range(0, max(1, len(parts)), _COLUMNS)]
        return np.concatenate(
            [
                np.einsum("kc,krc->rc", powers[:, block], self.series @ result[:, block])
                for block in blocks
            ],
            axis=1,
        )

    def _split(self, parts: Floats) -> tuple[list[tuple[Floats, Integers]], Floats]:
        """Split each s in `parts` into terms 1, 1/2, 1/4, ... (binary digits) and a remainder.

        Returns the exponential of each term, with the indices of `parts` that contain the term.
        Powers of the remainders in units of the last term follow, shape (powers, parts).
        """
        numbers = parts * 2.0**self.halvings
        whole = numbers.astype(int)
        bits = (whole >> np.arange(self.halvings, -1, -1)[:, None]) & 1
        places = (bit.nonzero()[0] for bit in bits)
        steps = [(halved, far) for halved, far in zip(self.halved, places, strict=True) if len(far)]
        powers: Floats = (numbers - whole) ** np.arange(len(self.series))[:, None]
        return steps, powers

    def repeated(self, first: Floats, count: int) -> Floats:
        """Return the states at s = 0, 1, 2, ..., `count` - 1, shape (size, count)."""
        states, level = first[:, None], 0
        while states.shape[1] < count:
            if level == len(self.doubled):
                self.doubled.append(self._squared(self.doubled[-1]))
            states = np.concatenate([states, self.doubled[level] @ states], axis=1)
            level += 1
        return states[:, :count]


def _terms(first: Floats, matrix: Floats, dense: int, last: int) -> Iterator[Floats]:
    """Yield the terms of the exponential series up to a number, beginning with `first`.

    Below its first `dense` rows, the matrix is 0 except for numbers right above its diagonal.
    """
    chains = np.diag(matrix, 1)[dense:]
    yield first
    for number in range(1, last + 1):
        term = first[:, :dense] @ matrix[:dense]
        term[:, dense + 1 :] += first[:, dense:-1] * chains
        first = term / number
        yield first
