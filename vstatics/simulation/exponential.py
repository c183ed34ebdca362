"""The exponential of a matrix for any part of a time, and states that follow from one another."""

from __future__ import annotations

import numpy as np

from vstatics.numerics.arrays import Floats

_NONE = np.zeros(0)
_TERMS = 22
"""Of the series."""


class Exponential:
    """``exp(A s)`` for s from 0 to 1: by its series, after so many halvings.

    Examples
    --------
    >>> decay = Exponential(np.array([[-3.0]]))
    >>> decay.at(np.array([0.0, 1.0]))[:, 0, 0].round(6)
    array([1.      , 0.049787])
    """

    def __init__(self, matrix: Floats, nodes: Floats = _NONE) -> None:
        norm = float(np.abs(matrix).sum(axis=0).max(initial=0.0))
        self.halvings = max(0, int(np.ceil(np.log2(norm / 2.0)))) if norm > 2.0 else 0
        step = matrix / 2.0**self.halvings
        terms = [np.eye(len(matrix))]
        for number in range(1, _TERMS + 1):
            terms.append(terms[-1] @ step / number)
        self.series = np.array(terms)
        self.doubled = [self.at(np.ones(1))[0]]
        """For 1, 2, 4, ..."""
        self.nodes = self.at(nodes)
        """For the parts of the time that are asked for again and again."""

    def at(self, parts: Floats) -> Floats:
        """For parts of the time, each 0 to 1; shape (parts, size, size)."""
        factors = parts[:, None] ** np.arange(len(self.series))
        size = self.series.shape[1]
        made: Floats = (factors @ self.series.reshape(len(self.series), -1)).reshape(-1, size, size)
        for _ in range(self.halvings):
            made = made @ made
        return made

    def repeated(self, first: Floats, count: int) -> Floats:
        """States at the start of each of so many equal parts, shape (size, parts)."""
        made, level = first[:, None], 0
        while made.shape[1] < count:
            if level == len(self.doubled):
                self.doubled.append(self.doubled[-1] @ self.doubled[-1])
            made = np.hstack([made, self.doubled[level] @ made])
            level += 1
        return made[:, :count]
