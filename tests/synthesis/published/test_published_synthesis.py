"""Tables 10 to 15 of the synthesis of planetary gearboxes, and what its pairs of controls are.

Source: Evseenko, Method of synthesis of planetary gearboxes with any number of degrees of
freedom (in Russian), an example with two sets. Printed: links of table 10 (a sun, h carrier,
b ring), scheme 22 of tables 11 and 12, clutches of table 13, pairs of table 14, those kept
in table 15. Not printed: what the pairs are. It follows here from the equations of the two
sets in exact fractions, for every scheme and every choice of its links J1 to J4.
"""

import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from itertools import combinations, permutations

import numpy as np
import pytest

from tests.commands import ROOT
from tests.oracle.combinations import Train, every
from vstatics import Gear, ShiftElement, load, solve
from vstatics.synthesis.gears.search import combinations as combinations_of

PAGE = ROOT / "docs" / "synthesis" / "tables.md"
CASE_OF_THE_PAGE = ROOT / "docs" / "sources" / "cases" / "two-sets.yaml"
TABLE_10 = "a1 h1 b1 a2 h2 b2 a1,a2 a1,h2 a1,b2 h1,a2 h1,h2 h1,b2 b1,a2 b1,h2 b1,b2"
ELEMENTS = ["a1", "h1", "b1", "a2", "h2", "b2"]
PRINTED_SCHEMES = {22: (1, 2, 4, 14), 233: (1, 5, 10, 14), 686: (3, 4, 9, 11)}
PRINTED_SCHEMES[1145] = (5, 10, 14, 15)
"""Of table 11: first, some inside, of all 1365 choices of four of the fifteen links."""
ENGINE = 5
TABLE_13 = {
    "F1": (1, 2), "F2": (1, 3), "F3": (1, 4), "F4": (2, 3), "F5": (2, 4), "F6": (3, 4),
    "F7": (ENGINE, 1), "F8": (ENGINE, 2), "F9": (ENGINE, 3), "F10": (ENGINE, 4),
}  # fmt: skip
BRAKES = {"T1": (2, 0), "T2": (3, 0)}
PLACES_OF_TABLE_14 = (
    "1 F1 F2, 11 F1 T2, 12 F2 F3, 21 F2 T2, 22 F3 F4, 30 F3 T2, 31 F4 F5, 33 F4 F7, 34 F4 F8, "
    "38 F4 T2, 39 F5 F6, 45 F5 T2, 51 F6 T2, 52 F7 F8, 56 F7 T2, 57 F8 F9, 60 F8 T2, 61 F9 F10, "
    "63 F9 T2, 64 F10 T1, 65 F10 T2, 66 T1 T2"
)
TABLE_15 = [
    f"{clutch} {other}"
    for clutch in ("F7", "F8", "F9")
    for other in ("T1", "T2", "F1", "F2", "F3", "F4", "F5", "F6")
]
CONTROLS = TABLE_13 | BRAKES
PAIRS = [" ".join(pair) for pair in combinations(CONTROLS, 2)]
RATIOS = [Fraction(-2), Fraction(-26, 10)]


def schemes() -> Iterator[tuple[int, list[set[str]]]]:
    """Numbers and links of the schemes with four links in which each element is once."""
    links = [set(one.split(",")) for one in TABLE_10.split()]
    for number, chosen in enumerate(combinations(links, 4), 1):
        if sorted(element for link in chosen for element in link) == sorted(ELEMENTS):
            yield number, list(chosen)


def train(scheme: list[set[str]], controls: dict[str, tuple[int, int]] = CONTROLS) -> Train:
    """The scheme with the engine as a fifth link; its links in order are J1 to J4."""
    at = {element: number for number, link in enumerate(scheme, 1) for element in link}
    sets = [(at[f"a{n}"], at[f"b{n}"], at[f"h{n}"]) for n in (1, 2)]
    return Train(sets, RATIOS, list(controls.values()), ENGINE, 4)


def kinds(scheme: list[set[str]]) -> dict[str, str]:
    found = (one.kind for _, one in every(train(scheme), 2))
    return dict(zip(PAIRS, found, strict=True))


SCHEME_686 = next(scheme for number, scheme in schemes() if number == 686)


def rows(heading: str) -> list[list[str]]:
    """Cells of the last table under a heading that the page has, its own heading first."""
    text = PAGE.read_text("utf-8").partition(f"\n## {heading}\n")[2].partition("\n## ")[0]
    table = re.findall(r"(?:^\|.*\n)+", text, re.MULTILINE)[0].splitlines()
    return [[cell.strip() for cell in line[1:-1].split("|")] for line in table if "---" not in line]


def names(text: str) -> list[str]:
    """Return the clutches and brakes of a cell: ``F1 to F6``, or ``T1, T2``."""
    first, _, last = text.partition(" to ")
    ends = [int(end.removeprefix("F")) for end in (first, last) if last]
    return [f"F{n}" for n in range(ends[0], ends[1] + 1)] if last else text.split(", ")


def test_scheme_22_lacks_b2_and_18_of_1365_are_complete() -> None:
    numbered = dict(enumerate(combinations(range(1, 16), 4), 1))
    assert len(numbered) == 1365
    assert {n: numbered[n] for n in PRINTED_SCHEMES} == PRINTED_SCHEMES
    elements = ",".join(TABLE_10.split()[link - 1] for link in PRINTED_SCHEMES[22]).split(",")
    assert set(ELEMENTS) - set(elements) == {"b2"}
    found = [number for number, _ in schemes()]
    assert len(found) == 18
    text = PAGE.read_text("utf-8")
    assert ", ".join(map(str, found)) in text


def test_printed_pairs_are_all_pairs() -> None:
    assert len(PAIRS) == 66
    for printed in PLACES_OF_TABLE_14.split(", "):
        number, _, pair = printed.partition(" ")
        assert PAIRS[int(number) - 1] == pair


def test_printed_rules_leave_the_24_printed_pairs() -> None:
    engine = {"F7", "F8", "F9", "F10"}
    pairs = [frozenset(pair.split()) for pair in PAIRS]
    some = [pair for pair in pairs if pair & engine]
    one = [pair for pair in some if len(pair & engine) == 1]
    kept = [pair for pair in one if "F10" not in pair]
    assert (len(some), len(one), len(kept)) == (38, 32, 24)
    assert set(kept) == {frozenset(pair.split()) for pair in TABLE_15}


@pytest.mark.slow
def test_kinds_are_those_of_the_page_whatever_the_scheme() -> None:
    page: dict[str, str] = {}
    for first, second, kind, count in rows("Table 14")[1:]:
        pairs = set(PAIRS) & {f"{a} {b}" for a in names(first) for b in names(second)}
        assert len(pairs) == int(count), (first, second)
        assert not pairs & page.keys()
        page |= dict.fromkeys(pairs, kind)
    assert page.keys() == set(PAIRS)
    ways = [list(way) for _, scheme in schemes() for way in permutations(scheme)]
    assert len(ways) == 432
    assert all(kinds(way) == page for way in ways[::7])  # all 432 hold; they take 13 s
    counted = Counter(page.values())
    assert counted == {"direct": 32, "gear": 4, "blocked": 2, "parking": 13, "neutral": 15}


def test_of_the_24_printed_ones_4_are_gears() -> None:
    found = {" ".join(sorted(pair.split())): kind for pair, kind in kinds(SCHEME_686).items()}
    of = [found[" ".join(sorted(pair.split()))] for pair in TABLE_15]
    assert Counter(of) == {"direct": 18, "gear": 4, "blocked": 2}
    assert [n for n, kind in enumerate(of, 1) if kind == "gear"] == [1, 2, 10, 17]
    assert [n for n, kind in enumerate(of, 1) if kind == "blocked"] == [9, 18]


@pytest.mark.slow
def test_the_brake_that_was_left_out_gives_two_more_gears() -> None:
    """T3 on J1: F8 T3 and F9 T3 are gears, only F7 T3 is blocked."""
    controls = CONTROLS | {"T3": (1, 0)}
    for _, scheme in schemes():
        names = list(combinations(controls, 2))
        found = [one.kind for _, one in every(train(scheme, controls), 2)]
        by_pair = dict(zip(names, found, strict=True))
        engine = [by_pair[clutch, "T3"] for clutch in ("F7", "F8", "F9", "F10")]
        assert engine == ["blocked", "gear", "gear", "direct"]


def test_the_program_gives_the_gears_of_the_page() -> None:
    """Formulas in K, by hand from the Willis equations of scheme 686; K1 = -2, K2 = -2.6."""
    case = load(CASE_OF_THE_PAGE)
    k1, k2 = RATIOS
    forms = {
        "F7 T1": float(1 - 1 / (k1 * k2)),
        "F7 T2": float((k1 - 1) / k1),
        "F8 T2": float(1 - k2),
        "F9 T1": float((k2 - 1) / k2),
    }
    found = dict(zip((gear.name for gear in case.gears), solve(case).ratio.tolist(), strict=True))
    assert found == pytest.approx(forms | {"direct": 1.0}, rel=1e-14)
    line = re.compile(r"^\| (F\d T\d) \| .* \| .* \| (\S*) \|$", re.MULTILINE)
    rows = line.findall(PAGE.read_text("utf-8"))
    assert dict(rows) == {name: f"{form:.4f}".rstrip("0") for name, form in forms.items()}


def test_the_program_tells_the_kinds_of_table_14_in_its_order() -> None:
    """All 66, and with a brake on J1 besides the two gears that the source leaves out.

    As gears those with a ratio are direct drives, or gears.
    """
    case = load(CASE_OF_THE_PAGE)
    found = {" ".join(one.engaged): one.kind for one in combinations_of(case)}
    expected = kinds(SCHEME_686)
    assert [*found] == PAIRS
    assert found == expected
    gears = [Gear(pair) for pair in combinations(range(1, 13), 2)]
    with_ratio = np.isfinite(solve(replace(case, gears=gears)).ratio)
    assert with_ratio.tolist() == [kind in {"gear", "direct"} for kind in expected.values()]
    more = replace(case, shift_elements=[*case.shift_elements, ShiftElement(2, name="T3")])
    with_brake = [one for one in combinations_of(more) if "T3" in one.engaged]
    ratios = {one.engaged[0]: one.ratio for one in with_brake if one.kind == "gear"}
    k1, k2 = map(float, RATIOS)
    # b1 stands: a1 = (1 - K1) h; then F9 gives 1 - K1, F8 a2 = K2 a1 + (1 - K2) h
    assert ratios == pytest.approx({"F8": k2 * (1 - k1) + 1 - k2, "F9": 1 - k1}, rel=1e-14)
