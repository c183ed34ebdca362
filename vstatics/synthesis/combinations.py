"""What combinations of shift elements of a case do, one by one."""

from __future__ import annotations

from collections.abc import Sequence

from vstatics.model.transmission import Transmission
from vstatics.synthesis.combination_search import MOST_COMBINATIONS, CombinationSearch
from vstatics.synthesis.engaged_sets import EngagedSet


def combinations(
    case: Transmission,
    engaged: int | Sequence[int] = (),
    elements: str | Sequence[str] = (),
    at_most: int = MOST_COMBINATIONS,
) -> list[EngagedSet]:
    """All combinations of shift elements of a case, with their kinds and ratios.

    The kind follows from all speeds of input and output that mechanisms, springs at mean
    speeds and engaged elements allow:
    ``blocked``: the input can't turn;
    ``parking``: the output stands, while the input turns;
    ``neutral``: they are independent of each other;
    ``gear``: they have a fixed ratio; ``direct``: it is 1 whatever the ratios of the mechanisms.

    Parameters
    ----------
    case : Transmission
    engaged : int or sequence of int
        How many elements; as many as leave one degree of freedom when not given.
    elements : str or sequence of str
        To choose from, by names or numbers; all of the case when not given. ``"auto"``: all
        clutches and brakes that its scheme may have. A freewheel counts as one that holds.
    at_most : int
        So many combinations may be tried.

    Raises
    ------
    CaseError
        If there is no such element, or there are more combinations.

    Source
    ------
    docs/synthesis.md.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement
    >>> case = Transmission(3, [ShiftElement(2), ShiftElement(1, 2)],
    ...                     [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> for one in combinations(case):
    ...     print(*one)
    ['T1'] gear 3.5 False
    ['F2'] direct 1.0 False
    """
    sizes = [engaged] if isinstance(engaged, int) else engaged
    asked = [elements] if isinstance(elements, str) else elements
    search = CombinationSearch(case, sizes, asked)
    search.check(at_most)
    return [one for batch in search.batches() for one in batch.each()]
