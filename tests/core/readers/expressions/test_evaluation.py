"""Values of formulas: what they hold on to."""

import gc
import weakref

import numpy as np
import pytest

from vstatics.core.errors import ReadError
from vstatics.core.numerics.arrays import Floats
from vstatics.core.readers.expressions.evaluation import FUNCTIONS, evaluate
from vstatics.core.readers.expressions.excerpt import Excerpt
from vstatics.core.readers.expressions.grammar import Language, parse


class Held:
    """Stands for the results of variants."""

    def values(self, name: object) -> Floats:
        """One number whatever is asked for."""
        del name
        return np.array([[[1.0]]])


def test_what_was_asked_for_values_is_free_at_once() -> None:
    """The memory of results is used again only when nothing holds them: not even a circle."""
    held = Held()
    free = weakref.ref(held)
    tree = parse(Excerpt("max(t, 2) + t", "--where"), Language(FUNCTIONS, "t", "t"))
    gc.disable()
    try:
        assert evaluate(tree, held.values).item() == 3
        del held
        assert free() is None
    finally:
        gc.enable()


def test_a_formula_has_at_most_2000_characters() -> None:
    language = Language(FUNCTIONS, "a number", "t")
    longest = parse(Excerpt(f"1{'+1':>1999}", "--where"), language)
    assert evaluate(longest, Held().values).item() == 2
    with pytest.raises(ReadError, match="read 2001 characters, expected 2000 at most"):
        parse(Excerpt(f"1{'+1':>2000}", "--where"), language)
