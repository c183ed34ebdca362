"""Masses that turn as one: inertias and stiffnesses by C^T J C and C^T K C, equal branches."""

import numpy as np
import pytest
from scipy import linalg

from tests.chance import each_seed, generator
from tests.rejects import rejects
from vstatics import CaseError
from vstatics.torsion.reduction.merging import simplify_merging
from vstatics.torsion.reduction.scheme import (
    SchemeSpring,
    TorsionScheme,
    natural_frequencies,
    stiffness_matrix,
)  # fmt: skip


def fork(left: float = 1.0) -> TorsionScheme:
    ends = {"s": (0, 1, 0.5), "l": (1, 2, 1.0), "r": (1, 3, 1.0)}
    springs = [SchemeSpring(name, {a: 1, b: -1}, e) for name, (a, b, e) in ends.items()]
    return TorsionScheme(("a", "b", "l", "r"), (4.0, 2.0, left, 1.0), tuple(springs))


@each_seed(8)
def test_both_turn_as_one(seed: int) -> None:
    """Any springs, of three links and to the housing too: eigenvalues of C^T K C, C^T J C."""
    chance = generator(seed)
    names, inertias = tuple("abcde"), tuple(chance.uniform(0.5, 3, size=5).tolist())
    pairs = [(n, m) for n in range(5) for m in range(n)]
    springs = [
        SchemeSpring(f"s{n}{m}", {n: 1.0, m: -float(chance.choice([1.0, 2.5]))}, e)
        for (n, m), e in zip(pairs, chance.uniform(0.1, 2, size=10).tolist(), strict=True)
    ]
    given = TorsionScheme(names, inertias, (*springs, SchemeSpring("mount", {4: 1.0}, 1.0)))
    one, two = sorted(chance.choice(5, size=2, replace=False).tolist())
    joined = np.delete(np.eye(5), two, axis=1)
    joined[two, one] = 1.0
    stiffness = joined.T @ stiffness_matrix(given) @ joined
    masses = joined.T @ np.diag(inertias) @ joined
    omegas = np.sqrt(linalg.eigh(stiffness, masses, eigvals_only=True))
    pair = f"{names[two]}+{names[one]}"
    found = simplify_merging(given, 4, None, (), [pair])
    assert found.steps[0].omegas == pytest.approx(omegas, rel=1e-9)
    assert sum(found.scheme.inertias) == pytest.approx(sum(inertias))


def test_equal_branches_lose_the_mode_in_which_they_swing_against_each_other() -> None:
    """It is sqrt(1/(E J)) of one branch; all others stay."""
    [step] = simplify_merging(fork(), 2, None, (), ["l+r"]).steps
    assert step.partial_frequency == pytest.approx(1.0)
    before = natural_frequencies(fork())
    assert sorted([*step.omegas, 1.0]) == pytest.approx(before)
    assert step.names == ("a", "b", "l+r")
    assert step.compliances == pytest.approx((0.5, 0.5))


def test_a_merged_mass_has_a_name_to_merge_it_again() -> None:
    found = simplify_merging(fork(left=3.0), 1, None, (), ["l+r", "l+r+b"])
    assert [one.operation for one in found.steps] == ["merge l and r", "merge l+r and b"]
    assert found.scheme.names == ("a", "l+r+b")
    assert found.scheme.inertias == (4.0, 6.0)


def test_what_is_no_pair() -> None:
    for remove, merge, message in (
        ([], ["l+x"], "read `l+x` to merge"),
        ([], ["l"], "expected two links of the system as `A+B`"),
        ([], ["l+l"], "read `l+l` to merge"),
        ([], ["+"], "to merge"),
        (["l"], ["l+r"], "read `l+r` to merge"),
        ([], ["l+r", "l+b"], "read `l+b` to merge"),
        (["l", "r", "b", "a"], ["l+r"], "links to remove"),
    ):
        with rejects(CaseError, message):
            simplify_merging(fork(), 1, None, remove, merge)
