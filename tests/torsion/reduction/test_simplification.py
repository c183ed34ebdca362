"""Chains and branched schemes with masses taken out; printed tables are in a test of their own."""

import math

import numpy as np
import pytest

from tests.torsion.book import chain, scheme, table
from vstatics.core.errors import CaseError
from vstatics.torsion.reduction.chain import Chain, ChainSpring, partial_systems, scheme_of
from vstatics.torsion.reduction.condensation import without_massless
from vstatics.torsion.reduction.scheme import (
    SchemeSpring,
    TorsionScheme,
    natural_frequencies,
    stiffness_matrix,
)  # fmt: skip
from vstatics.torsion.reduction.simplification import (
    SIMPLIFICATION_RULES,
    acted_on_by_several,
    one_mass_systems,
    simplify,
    with_masses_merged,
    without_branch_mass,
    without_mass,
)  # fmt: skip

CHAIN = scheme_of(chain([50, 5, 2, 30, 1, 90], [40, 3, 8, 20, 70]))
PRINTED = [scheme(one["inertias"], one["springs"], 1e-6) for one in table("table_p1_2")["schemes"]]
BRANCHED = PRINTED[0]
STAR = TorsionScheme(
    tuple("abco"), (1.0, 1.0, 1.0, 6.0),
    tuple(SchemeSpring("abc"[m], {m: 1, 3: -1}, 1 / c) for m, c in enumerate((1, 2, 3))),
)  # fmt: skip


def row(inertias: list[float], *springs: tuple[float, ...]) -> Chain:
    """Masses a, b, ...; springs of compliance and damping."""
    names = tuple("abcdefgh"[: len(inertias)])
    return Chain(names, tuple(inertias), tuple(ChainSpring("s", *one) for one in springs))


def compliances(given: Chain) -> list[float]:
    return [spring.compliance for spring in given.springs]


def test_one_mass_and_two_masses_have_one_frequency() -> None:
    """(П1.4), (П1.5): a partial system becomes the other kind of the same frequency, and back."""
    one = row([0.0, 3.0, 0.0], (2.0,), (5.0,))
    [system, *_] = partial_systems(one._replace(inertias=(1.0, 3.0, 1.0)))
    two = without_mass(one, 1)
    assert two.inertias == pytest.approx((3 * 5 / 7, 3 * 2 / 7))
    [same] = partial_systems(two)
    assert same.frequency == pytest.approx(system.frequency)
    between = row([1.0, *two.inertias, 1.0], (0.0,), *((e,) for e in compliances(two)), (0.0,))
    back = with_masses_merged(between, 1)
    assert compliances(back) == pytest.approx([2, 5])
    assert back.inertias == pytest.approx((1, 3, 1))


def test_the_compliance_at_a_free_end_is_gone_and_the_inertia_that_goes_to_the_housing() -> None:
    given = row([3.0, 1.0, 5.0], (1.0,), (2.0,))
    for left, inertias, rest in (
        (with_masses_merged(given, 0), (4, 5), [2 + 1 * 3 / 4]),
        (with_masses_merged(given, 1), (3, 6), [1 + 2 * 5 / 6]),
        (without_mass(given, 0), (4, 5), [2]),
        (without_mass(given, 2), (3, 6), [1]),
        (without_mass(row([math.inf, 4.0, 5.0], (1.0,), (3.0,)), 1), (math.inf, 5 + 1), [4]),
    ):
        assert left.inertias == inertias
        assert compliances(left) == pytest.approx(rest)


def test_damping_of_chains() -> None:
    """(П1.14) and (П1.17): K = K12 (E12/E)^2 + ...; (П1.15), then (П1.16), as they are printed."""
    [spring] = without_mass(row([1, 1, 1], (2.0, 5.0), (3.0, 7.0)), 1).springs
    assert spring.damping == pytest.approx(5 * 0.4**2 + 7 * 0.6**2)
    whole = row([1, 1, 1, 1], (2.0, 5.0), (3.0, 7.0), (5.0, 1.0))
    [spring] = without_mass(without_mass(whole, 1), 1).springs
    assert spring.damping == pytest.approx(5 * 0.2**2 + 7 * 0.3**2 + 1 * 0.5**2)
    given = row([9.0, 3.0, 1.0, 9.0], (2.0, 5.0), (4.0, 8.0), (6.0, 7.0))
    part_left, part_right = 4 * 1 / 4, 4 * 3 / 4
    left, right = 8 / 2 * (4 / part_left) ** 2, 8 / 2 * (4 / part_right) ** 2
    expected = [
        5 * (2 / 3) ** 2 + left * (part_left / 3) ** 2,
        right * (part_right / 9) ** 2 + 7 * (6 / 9) ** 2,
    ]
    found = with_masses_merged(given, 1).springs
    assert [spring.damping for spring in found] == pytest.approx(expected)


@pytest.mark.parametrize("given", PRINTED, ids=["a", "b"])
def test_every_branch_mass_leaves_the_stiffness_of_static_condensation(
    given: TorsionScheme,
) -> None:
    """K - Kj Kj^T/Kjj, whichever mass it is."""
    whole = stiffness_matrix(given)
    for mass, column in enumerate(whole):
        others = np.delete(column, mass)
        expected = np.delete(np.delete(whole, mass, 0), mass, 1)
        expected -= np.outer(others, others) / column[mass]
        found = without_massless(without_branch_mass(given, mass, "r"))
        assert stiffness_matrix(found) == pytest.approx(expected, abs=1e-12 * abs(whole).max())


def test_shares_of_inertia() -> None:
    """(П1.7), (П1.6) and none, with |Cij|/Cjj of 1/6, 2/6 and 3/6; an end gives it all."""
    parts = [1 / 6, 2 / 6, 3 / 6]
    for rule, expected in (
        ("r", [1 + 6 * part for part in parts]),
        ("b", [1 + 6 * part**2 for part in parts]),
        ("u", [1, 1, 1]),
    ):
        left = without_branch_mass(STAR, 3, rule)  # type: ignore[arg-type]
        assert left.inertias == pytest.approx([*expected, 0])
    left = without_branch_mass(STAR, 0, "r")
    assert (left.names, left.inertias) == (("b", "c", "o"), (1, 1, 7))
    assert [spring.name for spring in left.springs] == ["b", "c"]


def test_an_end_stays_an_end_where_three_springs_met() -> None:
    """The meeting has no inertia any more: still one device acts on each mass.

    Partial frequencies by hand: Caa = 1 - 1/6 and so on, J = 2, 3, 4.
    """
    assert acted_on_by_several(STAR, 3)
    left = without_branch_mass(STAR, 3, "r")
    assert left.springs == STAR.springs
    assert not any(acted_on_by_several(left, mass) for mass in range(3))
    systems = one_mass_systems(left)
    assert [system.names for system in systems] == [("a",), ("b",), ("c",)]
    expected = [(1 - 1 / 6) / 2, (2 - 4 / 6) / 3, (3 - 9 / 6) / 4]
    assert [system.frequency**2 for system in systems] == pytest.approx(expected)


def problems(given: TorsionScheme, count: int, rule: str | None = None, *remove: str) -> list[str]:
    with pytest.raises(CaseError) as error:
        simplify(given, count, rule, remove)  # type: ignore[arg-type]
    return [problem.message for problem in error.value.problems]


def test_the_rule_follows_the_shape() -> None:
    assert simplify(CHAIN, 2).rule == "partial"
    assert simplify(BRANCHED, 2).rule == "r"
    assert simplify(CHAIN, 2, "b").rule == "b"
    told = (
        "read rule `partial`, expected r, b or u: the system is not a chain, `s4` is not a shaft "
        "between two links: it acts on 4, 5 and 6 with coefficients 1, -1 and -1"
    )
    assert problems(BRANCHED, 3, "partial") == [told]


@pytest.mark.parametrize("rule", SIMPLIFICATION_RULES)
def test_as_many_frequencies_stay_as_are_asked_for(rule: str) -> None:
    for count in (1, 5):
        found = simplify(CHAIN, count, rule)  # type: ignore[arg-type]
        assert [len(step.omegas) for step in found.steps] == [*range(4, count - 1, -1)]
    assert found.scheme == CHAIN  # nothing was taken out
    assert not found.warnings


def test_a_support_is_one_frequency_more() -> None:
    """A held chain of six masses has six, so one that is left has two."""
    held = CHAIN._replace(springs=(*CHAIN.springs, SchemeSpring("mount", {0: 1.0}, 0.01)))
    found = simplify(held, 2)
    assert (found.rule, len(found.steps)) == ("partial", 4)
    assert len(found.scheme.names) == len(found.scheme.springs) == 2


def test_at_a_tie_one_mass_goes_before_two_and_the_first_before_others() -> None:
    """The middle mass and the last two have one partial frequency: 5 = (1/1 + 1/4)/.25.

    Masses 2 and 3 of equal ones on equal shafts are alike, as rounding can't tell.
    """
    [step] = simplify(scheme_of(chain([40, 10, 40], [1, 0.25], unit=1)), 1).steps
    assert step.operation == "remove 2"
    assert step.partial_frequency**2 == pytest.approx(5)
    equal = scheme_of(chain([10] * 4, [1, 1 + 1e-12, 1], unit=1e-4))
    for rule in (None, "r"):
        assert simplify(equal, 2, rule).steps[0].operation == "remove 2"


def test_chains_are_in_their_order_and_branched_schemes_in_that_of_the_case() -> None:
    mixed = CHAIN._replace(
        names=("3", "1", "2"), inertias=(4.0, 4.0, 0.1),
        springs=(SchemeSpring("b", {2: 1, 0: -1}, 0.5), SchemeSpring("a", {1: 1, 2: -1}, 0.25)),
    )  # fmt: skip
    [step] = simplify(mixed, 1, remove=["3"]).steps
    assert (step.names, step.compliances, step.stiffness) == (("2", "1"), (0.25,), None)
    [step] = simplify(BRANCHED, 5).steps
    assert (step.names, step.compliances) == (("1", "2", "4", "5", "6", "7"), None)
    assert step.stiffness is not None
    [step] = simplify(CHAIN, 4, "r").steps
    assert step.compliances is not None
    assert step.stiffness is not None
    assert step.stiffness[0][1] == pytest.approx(-1 / step.compliances[0])


def test_ends_are_never_removed_by_a_rule_but_on_demand() -> None:
    """The mass 1 is light, so its partial frequency is the highest of all."""
    light_end = scheme_of(chain([0.001, 5, 2, 30], [40, 3, 8]))
    for rule in SIMPLIFICATION_RULES[1:]:
        assert simplify(light_end, 2, rule).steps[0].operation == "remove 3"
    for rule in SIMPLIFICATION_RULES:  # whichever: a mass with one spring goes to the next
        [step] = simplify(light_end, 2, rule, ["1"]).steps
        assert step.names == ("2", "3", "4")
        assert step.inertias[0] == pytest.approx(0.5 + 0.0001 * (rule != "u"))
        assert step.compliances == pytest.approx((3e-5, 8e-5))


def test_where_only_ends_are_left_no_rule_goes_on() -> None:
    """Three masses on a joint without inertia have two frequencies."""
    star = STAR._replace(inertias=(1.0, 1.0, 1.0, 0.0))
    told = (
        "the rule can remove no further link, because only one component acts on each of a, b, c; "
    )
    assert problems(star, 1) == [f"{told}name the links to remove with --remove"]
    assert simplify(star, 1, remove=["b"]).scheme.names == ("a", "c")


@pytest.mark.parametrize("rule", SIMPLIFICATION_RULES[1:])
@pytest.mark.parametrize("count", [1, 2, 3, 4])
def test_what_is_left_is_a_scheme(count: int, rule: str) -> None:
    found = simplify(PRINTED[1], count, rule)  # type: ignore[arg-type]
    last = found.steps[-1]
    assert found.scheme.inertias == last.inertias
    assert all(inertia > 0 for inertia in found.scheme.inertias)
    assert stiffness_matrix(found.scheme) == pytest.approx(np.array(last.stiffness))
    assert natural_frequencies(found.scheme) == pytest.approx(last.omegas)
    names = [spring.name for spring in found.scheme.springs]
    assert len({*names}) == len(names)


def test_masses_without_inertia_go_before_the_first_step() -> None:
    ends = {"s": (0, 1, 0.75), "t": (1, 2, 0.25), "u": (2, 3, 0.25)}
    springs = tuple(SchemeSpring(name, {a: 1, b: -1}, e) for name, (a, b, e) in ends.items())
    cut = TorsionScheme(("a", "joint", "b", "c"), (4.0, 0.0, 1.0, 4.0), springs)
    [step] = simplify(cut, 1).steps
    assert step.operation == "remove b"
    assert step.inertias == pytest.approx((4.2, 4.8))  # 1/5 and 4/5 of it
    assert step.compliances == pytest.approx((1.25,))


def test_a_warning_where_a_kept_frequency_is_near_to_one_that_is_gone() -> None:
    """Table П1.2, a: with two frequencies 142 of 265 rad/s, with three 269 of 604 rad/s."""
    [warning] = simplify(BRANCHED, 2).warnings
    assert warning.severity == "warning"
    assert warning.message == (
        "the remaining frequency 142.4 rad/s is more than half of the removed partial "
        "frequency 265.5 rad/s (remove 6): it can be more than 5 % off"
    )
    assert simplify(BRANCHED, 3).warnings == ()


def test_what_is_asked_for_must_be_possible() -> None:
    apart = CHAIN._replace(names=(*CHAIN.names, "apart"), inertias=(*CHAIN.inertias, 1.0))
    light = CHAIN._replace(inertias=(*CHAIN.inertias[:2], 0.0, *CHAIN.inertias[3:]))
    remain = "natural frequencies to remain (--links), expected 1 to 5: the system has 5"
    most = "expected 1 at most, so that 4 of 5 natural frequencies remain"
    of_scheme = "to remove, expected a link of the simplified system; did you mean `3`?"
    for given, count, remove, told in (
        (CHAIN, 0, (), f"read 0 {remain}"),
        (CHAIN, 6, (), f"read 6 {remain}"),
        (CHAIN, 4, ("2", "3"), f"read 2 links to remove, {most}"),
        (CHAIN, 3, ("33",), f"read `33` {of_scheme}"),
        (CHAIN, 3, ("2", "2"), "read `2` to remove, which is already removed"),
        (apart, 2, ("apart",), "`apart` cannot be removed: no component acts on it"),
        (light, 2, ("3",), "read `3` to remove, expected a link with inertia"),
        (TorsionScheme(("a",), (1.0,), ()), 1, (), "read 1 natural frequency to remain (--links), "
         "but the system has none"),
    ):  # fmt: skip
        assert problems(given, count, None, *remove) == [told]
