"""Which system is taken out, how many stay, what is said. Printed tables are in a test of their own."""

from __future__ import annotations

import numpy as np
import pytest

from tests.torsion.book import chain, scheme, table
from vstatics.core.errors import CaseError
from vstatics.torsion.reduction.chain import scheme_of
from vstatics.torsion.reduction.scheme import (
    SchemeSpring,
    TorsionScheme,
    natural_frequencies,
    stiffness_matrix,
)
from vstatics.torsion.reduction.simplification import SIMPLIFICATION_RULES, simplify

CHAIN = scheme_of(chain([50, 5, 2, 30, 1, 90], [40, 3, 8, 20, 70]))
PART = table("table_p1_2")["schemes"][0]
BRANCHED = scheme(PART["inertias"], PART["springs"], 1e-6)
EQUAL = scheme_of(chain([40, 10, 40], [1, 0.25], unit=1))
"""The middle mass and the last two have one partial frequency: 5 = (1/1 + 1/4)/.25."""


def said(error: pytest.ExceptionInfo[CaseError]) -> list[str]:
    """The problems of an error."""
    return [problem.message for problem in error.value.problems]


def test_the_rule_follows_the_shape() -> None:
    assert simplify(CHAIN, 2).rule == "partial"
    assert simplify(BRANCHED, 2).rule == "r"
    assert simplify(CHAIN, 2, "b").rule == "b"


@pytest.mark.parametrize("rule", SIMPLIFICATION_RULES)
def test_as_many_frequencies_stay_as_are_asked_for(rule: str) -> None:
    for count in range(1, 6):
        found = simplify(CHAIN, count, rule)  # type: ignore[arg-type]
        assert [len(step.omegas) for step in found.steps] == [*range(4, count - 1, -1)]
        assert len(natural_frequencies(found.scheme)) == count


def test_a_support_is_one_frequency_more() -> None:
    """A held chain of six masses has six, so one that is left has two."""
    mount = SchemeSpring("mount", {0: 1.0}, 0.01)
    held = CHAIN._replace(springs=(*CHAIN.springs, mount))
    found = simplify(held, 2)
    assert found.rule == "partial"
    assert len(found.steps) == 4
    assert len(found.scheme.names) == len(found.scheme.springs) == 2


def test_at_a_tie_one_mass_goes_before_two() -> None:
    [step] = simplify(EQUAL, 1).steps
    assert step.operation == "remove 2"
    assert step.partial_frequency**2 == pytest.approx(5)


def test_at_a_tie_the_first_goes() -> None:
    """Equal masses on equal shafts: 2 and 3 alike, as rounding can't tell."""
    equal = scheme_of(chain([10] * 4, [1, 1 + 1e-12, 1], unit=1e-4))
    assert simplify(equal, 2).steps[0].operation == "remove 2"
    assert simplify(equal, 2, "r").steps[0].operation == "remove 2"


def test_chains_are_in_their_order_and_branched_schemes_in_that_of_the_case() -> None:
    mixed = CHAIN._replace(
        names=("3", "1", "2"),
        inertias=(4.0, 4.0, 0.1),
        springs=(SchemeSpring("b", {2: 1, 0: -1}, 0.5), SchemeSpring("a", {1: 1, 2: -1}, 0.25)),
    )
    [step] = simplify(mixed, 1, remove=["3"]).steps
    assert step.names == ("2", "1")
    assert step.compliances == (0.25,)
    assert step.stiffness is None
    [step] = simplify(BRANCHED, 5).steps
    assert step.names == ("1", "2", "4", "5", "6", "7")
    assert step.compliances is None
    assert step.stiffness is not None


def test_a_chain_by_one_mass_systems_has_compliances_and_a_matrix() -> None:
    [step] = simplify(CHAIN, 4, "r").steps
    assert step.compliances is not None
    assert step.stiffness is not None
    assert len(step.compliances) == 4
    assert step.stiffness[0][1] == pytest.approx(-1 / step.compliances[0])


def test_ends_are_never_removed_by_a_rule_but_on_demand() -> None:
    """The mass 1 is light, so its partial frequency is the highest of all."""
    light_end = scheme_of(chain([0.001, 5, 2, 30], [40, 3, 8]))
    for rule in SIMPLIFICATION_RULES[1:]:
        assert simplify(light_end, 2, rule).steps[0].operation == "remove 3"
    [step] = simplify(light_end, 2, "r", ["1"]).steps
    assert step.names == ("2", "3", "4")
    assert step.inertias[0] == pytest.approx(0.0001 + 0.5)
    for rule in SIMPLIFICATION_RULES:  # whichever: a mass with one spring gives all to the next
        [step] = simplify(light_end, 2, rule, ["1"]).steps
        assert step.compliances == pytest.approx((3e-5, 8e-5))


def test_where_only_ends_are_left_no_rule_goes_on() -> None:
    """Three masses on a joint without inertia have two frequencies."""
    springs = tuple(SchemeSpring(f"s{mass}", {mass: 1, 3: -1}, 1.0) for mass in range(3))
    star = TorsionScheme(tuple("abco"), (1.0, 1.0, 1.0, 0.0), springs)
    with pytest.raises(CaseError) as error:
        simplify(star, 1)
    assert said(error) == [
        "no link remains that a rule removes, as only one component acts on each of a, b, c; "
        "name the links to remove"
    ]
    assert simplify(star, 1, remove=["b"]).scheme.names == ("a", "c")


def test_named_masses_go_first_then_the_rule_goes_on() -> None:
    found = simplify(CHAIN, 2, remove=["5", "2"])
    operations = [step.operation for step in found.steps]
    assert operations[:2] == ["remove 5", "remove 2"]
    assert len(operations) == 3


def test_rule_r_on_a_chain_keeps_the_sum_of_inertias() -> None:
    for rule in ("partial", "r"):
        for step in simplify(CHAIN, 1, rule).steps:
            assert sum(step.inertias) == pytest.approx(sum(CHAIN.inertias))


@pytest.mark.parametrize("rule", SIMPLIFICATION_RULES[1:])
@pytest.mark.parametrize("count", [1, 2, 3, 4])
def test_what_is_left_is_a_scheme(count: int, rule: str) -> None:
    """Its springs have the stiffness of the last step, and every mass has inertia."""
    part = table("table_p1_2")["schemes"][1]
    given = scheme(part["inertias"], part["springs"], 1e-6)
    found = simplify(given, count, rule)  # type: ignore[arg-type]
    last = found.steps[-1]
    assert found.scheme.inertias == last.inertias
    assert all(inertia > 0 for inertia in found.scheme.inertias)
    assert stiffness_matrix(found.scheme) == pytest.approx(np.array(last.stiffness))
    assert natural_frequencies(found.scheme) == pytest.approx(last.omegas)
    names = [spring.name for spring in found.scheme.springs]
    assert len({*names}) == len(names)


def test_masses_without_inertia_go_before_the_first_step() -> None:
    """A shaft in two pieces is one chain, and the order of its ends stays."""
    cut = TorsionScheme(
        ("a", "joint", "b", "c"),
        (4.0, 0.0, 1.0, 4.0),
        (
            SchemeSpring("s", {0: 1, 1: -1}, 0.75),
            SchemeSpring("t", {1: 1, 2: -1}, 0.25),
            SchemeSpring("u", {2: 1, 3: -1}, 0.25),
        ),
    )
    [step] = simplify(cut, 1).steps
    [same] = simplify(EQUAL, 1).steps
    assert step.operation == "remove b"
    assert step.inertias == pytest.approx(same.inertias)
    assert step.compliances == pytest.approx(same.compliances)


def test_no_step_where_nothing_is_to_be_taken_out() -> None:
    found = simplify(CHAIN, 5)
    assert not found.steps
    assert not found.warnings
    assert found.scheme == CHAIN


def test_a_warning_where_a_kept_frequency_is_near_to_one_that_is_gone() -> None:
    """Table П1.2, a: with two frequencies 142 of 265 rad/s, with three 269 of 604 rad/s."""
    [warning] = simplify(BRANCHED, 2).warnings
    assert warning.severity == "warning"
    assert warning.message == (
        "the remaining frequency 142.4 rad/s is more than half of the removed partial "
        "frequency 265.5 rad/s (remove 6): it can be more than 5 % off"
    )
    assert simplify(BRANCHED, 3).warnings == ()


def test_partial_is_for_chains() -> None:
    with pytest.raises(CaseError) as error:
        simplify(BRANCHED, 3, "partial")
    assert said(error) == [
        "read rule `partial`, expected r, b or u: the scheme is not a chain, `s4` is not a shaft "
        "between two links: it acts on 4, 5 and 6 with coefficients 1, -1 and -1"
    ]


@pytest.mark.parametrize(
    ("count", "remove", "message"),
    [
        (
            0,
            [],
            "read 0 natural frequencies to remain (--links), expected 1 to 5: the scheme has 5",
        ),
        (
            6,
            [],
            "read 6 natural frequencies to remain (--links), expected 1 to 5: the scheme has 5",
        ),
        (
            4,
            ["2", "3"],
            "read 2 links to remove, expected 1 at most, so that 4 of 5 natural frequencies remain",
        ),
        (3, ["33"], "read `33` to remove, expected a link of the scheme; did you mean `3`?"),
        (3, ["2", "2"], "read `2` to remove, which is already removed"),
    ],
)
def test_what_is_asked_for_must_be_possible(count: int, remove: list[str], message: str) -> None:
    with pytest.raises(CaseError) as error:
        simplify(CHAIN, count, remove=remove)
    assert said(error) == [message]


def test_a_scheme_without_vibrations() -> None:
    with pytest.raises(CaseError) as error:
        simplify(TorsionScheme(("a",), (1.0,), ()), 1)
    assert said(error) == ["read 1 natural frequency to remain (--links), but the scheme has none"]


def test_a_mass_that_no_device_acts_on_is_not_removed() -> None:
    apart = CHAIN._replace(names=(*CHAIN.names, "apart"), inertias=(*CHAIN.inertias, 1.0))
    with pytest.raises(CaseError) as error:
        simplify(apart, 2, remove=["apart"])
    assert said(error) == ["`apart` cannot be removed: no component acts on it"]


def test_a_mass_without_inertia_is_not_named() -> None:
    light = CHAIN._replace(inertias=(*CHAIN.inertias[:2], 0.0, *CHAIN.inertias[3:]))
    with pytest.raises(CaseError) as error:
        simplify(light, 2, remove=["3"])
    assert said(error) == ["read `3` to remove, expected a link with inertia"]
