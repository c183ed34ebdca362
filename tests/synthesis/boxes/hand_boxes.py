"""Gearboxes that are built, as a search for boxes would have found them; links as in `cases/`."""

from vstatics.synthesis.boxes.box import HELD, BoxSearch, FoundBox
from vstatics.synthesis.structures.scheme import SetScheme


def _box(
    sets: tuple[tuple[int, int, int], ...],
    ports: tuple[int, int],
    elements: dict[str, tuple[int, int]],
    gears: str,
    ratios: tuple[float, ...],
) -> FoundBox:
    """Gears by the letters of their engaged elements."""
    engaged = tuple(tuple([*elements].index(one) for one in gear) for gear in gears.split())
    own = tuple(elements.values())
    return FoundBox(SetScheme(sets), None, *ports, own, ratios, engaged, 0.0)


ZF_8HP = _box(  # cases/zf-8hp70.yaml: carrier 2, sun 1-2, ring 1, carrier 1, ring 2, ..
    ((1, 3, 2), (1, 0, 4), (4, 6, 5), (5, 7, 3)),
    (0, 7),
    {"A": (1, HELD), "B": (2, HELD), "C": (0, 5), "D": (6, 7), "E": (4, 5)},
    "ABC ABE BCE BDE BCD CDE ACD ADE ABD",
    (-96 / 48, -96 / 48, -111 / 69, -85 / 23),
)
ZF_8HP_SEARCH = BoxSearch(4, 5, 3, (4.70, 3.13, 2.10, 1.67, 1.28, 1.0, 0.84, 0.67, -3.30))

SIMPSON = _box(  # cases/simpson.yaml: sun, output, ring 1, carrier 2; the input joins none
    ((0, 1, 2), (0, 3, 1)),
    (4, 1),
    {"A": (4, 2), "B": (4, 0), "C": (0, HELD), "D": (3, HELD)},
    "AD AC AB BD",
    (-73 / 35, -73 / 35),
)
SIMPSON_SEARCH = BoxSearch(2, 4, 2, (2.4795, 1.4795, 1.0, -2.0857), own_input=True)

ZF_6HP = _box(  # cases/zf-6hp26.yaml: ring, held sun, carrier; suns, carrier, ring of the rear
    ((1, 2, 0), (4, 5, 6), (3, 5, 6)),
    (0, 6),
    {"A": (2, 3), "B": (2, 4), "E": (0, 5), "C": (4, HELD), "D": (5, HELD)},
    "AD AC AB AE BE CE BD",
    (-71 / 37, -85 / 38, 85 / 31),
)._replace(held=1)
_SIX = (4.171, 2.340, 1.521, 1.143, 0.867, 0.691, -3.403)
ZF_6HP_SEARCH = BoxSearch(3, 5, 2, _SIX, meshed=1, fixed=1)

FORD_10R = _box(  # cases/ford-10r80.yaml: input, sun 1-2, rings 1, 2, 3, carrier 1, sun 4, output
    ((1, 5, 2), (1, 0, 3), (3, 5, 4), (6, 7, 5)),
    (0, 7),  # 8 is the intermediate shaft
    {"A": (2, HELD), "B": (1, HELD), "C": (3, 8), "D": (6, 8), "E": (0, 6), "F": (4, 8)},
    "ABDE ABCD ACDE ACDF ACEF ADEF CDEF BDEF BCEF BCDF ABDF",
    (-95 / 45, -89 / 51, -119 / 73, -85 / 23),
)
_TEN = (4.696, 2.985, 2.146, 1.769, 1.520, 1.275, 1.0, 0.854, 0.689, 0.636, -4.866)
FORD_10R_SEARCH = BoxSearch(4, 6, 4, _TEN, shafts=1)

CROWDED = _box(  # all that can be joined: a complete graph of five
    ((0, 1, 2),),
    (3, 2),
    {"A": (0, HELD), "B": (1, HELD), "C": (0, 2), "D": (0, 3), "E": (1, 3), "F": (2, 3)},
    "AE BD CF",
    (-2.0,),
)
CROWDED_SEARCH = BoxSearch(1, 6, 2, (2 / 3, -2.0, 1.0), own_input=True)
