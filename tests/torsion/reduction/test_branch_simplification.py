"""A branched scheme with one mass less: stiffness, shares of inertia, what is an end."""

from __future__ import annotations

import numpy as np
import pytest

from tests.torsion.book import scheme, table
from vstatics.torsion.reduction.condensation import without_massless
from vstatics.torsion.reduction.scheme import SchemeSpring, TorsionScheme, stiffness_matrix
from vstatics.torsion.reduction.simplification import (
    acted_on_by_several,
    one_mass_systems,
    without_branch_mass,
)

STAR = TorsionScheme(
    tuple("abco"),
    (1.0, 1.0, 1.0, 6.0),
    tuple(SchemeSpring(n, {m: 1, 3: -1}, 1 / c) for m, (n, c) in enumerate(zip("abc", (1, 2, 3), strict=True))),
)  # fmt: skip


@pytest.mark.parametrize("part", table("table_p1_2")["schemes"], ids=["a", "b"])
def test_every_mass_leaves_the_stiffness_of_static_condensation(part: dict[str, object]) -> None:
    """K - Kj Kj^T/Kjj, whichever mass it is."""
    given = scheme(part["inertias"], part["springs"], 1e-6)  # type: ignore[arg-type]
    whole = stiffness_matrix(given)
    for mass in range(len(given.names)):
        column = whole[mass]
        expected = np.delete(np.delete(whole, mass, 0), mass, 1)
        others = np.delete(column, mass)
        expected -= np.outer(others, others) / column[mass]
        found = without_massless(without_branch_mass(given, mass, "r"))
        size = abs(whole).max()
        assert stiffness_matrix(found) == pytest.approx(expected, abs=1e-12 * size)


def test_shares_of_inertia() -> None:
    """(П1.7), (П1.6) and none, with |Cij|/Cjj of 1/6, 2/6 and 3/6."""
    parts = [1 / 6, 2 / 6, 3 / 6]
    for rule, expected in (
        ("r", [1 + 6 * part for part in parts]),
        ("b", [1 + 6 * part**2 for part in parts]),
        ("u", [1, 1, 1]),
    ):
        left = without_branch_mass(STAR, 3, rule)  # type: ignore[arg-type]
        assert left.inertias == pytest.approx([*expected, 0])


def test_an_end_stays_an_end_where_three_springs_met() -> None:
    """The meeting has no inertia any more: still one device acts on each mass."""
    assert acted_on_by_several(STAR, 3)
    left = without_branch_mass(STAR, 3, "r")
    assert left.springs == STAR.springs
    assert not any(acted_on_by_several(left, mass) for mass in range(3))


def test_the_device_of_an_end_goes_with_it() -> None:
    left = without_branch_mass(STAR, 0, "r")
    assert left.names == ("b", "c", "o")
    assert left.inertias == (1, 1, 7)
    assert [spring.name for spring in left.springs] == ["b", "c"]


def test_partial_frequencies_are_those_of_the_condensed_stiffness() -> None:
    """A star without its middle: by hand Caa = 1 - 1/6 and so on, J = 2, 3, 4."""
    left = without_branch_mass(STAR, 3, "r")
    systems = one_mass_systems(left)
    assert [system.names for system in systems] == [("a",), ("b",), ("c",)]
    expected = [(1 - 1 / 6) / 2, (2 - 4 / 6) / 3, (3 - 9 / 6) / 4]
    assert [system.frequency**2 for system in systems] == pytest.approx(expected)
