"""Values of formulas: what they hold on to."""

import gc
import weakref

import numpy as np

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
