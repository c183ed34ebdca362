"""Gearboxes that are built, as a search for boxes would have found them; links as in `cases/`."""

from vstatics.synthesis.boxes.box import HELD, BoxSearch, FoundBox
from vstatics.synthesis.structures.scheme import SetScheme


def _gears(letters: str, engaged: str) -> tuple[tuple[int, ...], ...]:
    return tuple(tuple(letters.index(one) for one in gear) for gear in engaged.split())


ZF_8HP = FoundBox(  # cases/zf-8hp70.yaml: carrier 2, sun 1-2, ring 1, carrier 1, ring 2, ..
    SetScheme(((1, 3, 2), (1, 0, 4), (4, 6, 5), (5, 7, 3))),
    None,
    0,
    7,
    ((1, HELD), (2, HELD), (0, 5), (6, 7), (4, 5)),
    (-96 / 48, -96 / 48, -111 / 69, -85 / 23),
    _gears("ABCDE", "ABC ABE BCE BDE BCD CDE ACD ADE ABD"),
    0.0,
)
ZF_8HP_SEARCH = BoxSearch(4, 5, 3, (4.70, 3.13, 2.10, 1.67, 1.28, 1.0, 0.84, 0.67, -3.30))

SIMPSON = FoundBox(  # cases/simpson.yaml: sun, output, ring 1, carrier 2; the input joins none
    SetScheme(((0, 1, 2), (0, 3, 1))),
    None,
    4,
    1,
    ((4, 2), (4, 0), (0, HELD), (3, HELD)),
    (-73 / 35, -73 / 35),
    _gears("ABCD", "AD AC AB BD"),
    0.0,
)
SIMPSON_SEARCH = BoxSearch(2, 4, 2, (2.4795, 1.4795, 1.0, -2.0857), own_input=True)

ZF_6HP = FoundBox(  # cases/zf-6hp26.yaml: ring, held sun, carrier; suns, carrier, ring of the rear
    SetScheme(((1, 2, 0), (4, 5, 6), (3, 5, 6))),
    1,
    0,
    6,
    ((2, 3), (2, 4), (0, 5), (4, HELD), (5, HELD)),
    (-71 / 37, -85 / 38, 85 / 31),
    _gears("ABECD", "AD AC AB AE BE CE BD"),
    0.0,
)
ZF_6HP_SEARCH = BoxSearch(
    3, 5, 2, (4.171, 2.340, 1.521, 1.143, 0.867, 0.691, -3.403), meshed=1, fixed=1
)

FORD_10R = (
    FoundBox(  # cases/ford-10r80.yaml: input, sun 1-2, rings 1, 2, 3, carrier 1, sun 4, output
        SetScheme(((1, 5, 2), (1, 0, 3), (3, 5, 4), (6, 7, 5))),
        None,
        0,
        7,
        ((2, HELD), (1, HELD), (3, 8), (6, 8), (0, 6), (4, 8)),  # 8 is the intermediate shaft
        (-95 / 45, -89 / 51, -119 / 73, -85 / 23),
        _gears("ABCDEF", "ABDE ABCD ACDE ACDF ACEF ADEF CDEF BDEF BCEF BCDF ABDF"),
        0.0,
    )
)
FORD_10R_SEARCH = BoxSearch(
    *(4, 6, 4, (4.696, 2.985, 2.146, 1.769, 1.520, 1.275, 1.0, 0.854, 0.689, 0.636, -4.866)),
    shafts=1,
)

CROWDED = FoundBox(  # all that can be joined: a complete graph of five
    SetScheme(((0, 1, 2),)),
    None,
    3,
    2,
    ((0, HELD), (1, HELD), (0, 2), (0, 3), (1, 3), (2, 3)),
    (-2.0,),
    ((0, 4), (1, 3), (2, 5)),
    0.0,
)
CROWDED_SEARCH = BoxSearch(1, 6, 2, (2 / 3, -2.0, 1.0), own_input=True)
