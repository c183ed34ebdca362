"""Natural frequencies of sweeps: those of `torsion modes`, counted as there, and their gears."""

import math
from typing import Any

import numpy as np
import pytest

from tests.torsion.systems import chain, with_planetary_set
from vstatics import Gear, Mechanism, ShiftElement, Spring, Transmission, loads
from vstatics.sweep import sweep
from vstatics.sweep.chunk import STATUS, Chunk
from vstatics.torsion.vibration.gear_modes import modes

SHAFT = chain([0.2, 0.8], [500.0])
"""Two masses: ``omega^2 = c (1/J1 + 1/J2)``, and a rigid mode that is not counted."""
NAMED = chain([0.15, 0.01, 1.5], [1190.0, 9000.0])
NAMED = NAMED.replace(
    springs=[NAMED.springs[0]._replace(name="damper"), NAMED.springs[1]._replace(name="shaft")],
    link_names=("engine", "disc", "wheel"),
)
"""Three masses with names, free at both ends."""


def only(case: Transmission, *vary: Any, **options: Any) -> Chunk:
    [made] = sweep(case, vary, **options)
    return made


def alone(case: Transmission, gear: int | str = 1, **options: Any) -> list[float]:
    """The frequencies of a gear as `torsion modes` gives them; NaN for those it does not have."""
    [found] = modes(case, [gear], **options)
    return [mode.omega for mode in found.modes] + [math.nan] * 4


def with_spring(case: Transmission, name: str, stiffness: float) -> Transmission:
    springs = [
        one._replace(stiffness=stiffness, compliance=None) if one.name == name else one
        for one in case.springs
    ]
    return case.replace(springs=springs)


def statuses(made: Chunk) -> list[str]:
    return [STATUS[code] for code in made.status]


def test_two_masses_on_a_shaft() -> None:
    made = only(SHAFT, "shaft 1.stiffness=100,400", "2.inertia=0.8,0.2", out="omega[1,1]")
    expected = [math.sqrt(c * (1 / 0.2 + 1 / j)) for c in (100, 400) for j in (0.8, 0.2)]
    np.testing.assert_allclose(made.columns[:, 0], expected, rtol=1e-13)
    assert made.names == ("shaft 1.stiffness", "2.inertia")
    assert statuses(made) == ["ok"] * 4
    by_stiffness = only(NAMED, "damper.stiffness=100,400", out="omega")
    by_compliance = only(NAMED, "damper.compliance=1/100,1/400", out="omega")
    np.testing.assert_allclose(by_stiffness.columns, by_compliance.columns, rtol=1e-15)


def elastic(spring: float = 900.0, clutch: float = 1e4, mechanism: float = 1e5) -> Transmission:
    case = with_planetary_set(
        shift_elements=[ShiftElement(2, 3, name="C", stiffness=clutch)],
        mechanisms=[Mechanism(2, 3, 4, ratio=-2.5, name="P", stiffness=mechanism)],
    )
    return with_spring(case, "in", spring)


def test_a_spring_a_clutch_and_a_mechanism_may_be_elastic() -> None:
    for device, name in (("in", "spring"), ("C", "clutch"), ("P", "mechanism")):
        (made,) = sweep(elastic(), {f"{device}.stiffness": [2e3, 3e4]}, out="omega[1], omega[2]")
        for [value], row in zip(made.values, made.columns, strict=True):
            given = elastic(**{name: value})
            expected = [alone(given, gear)[mode] for mode in (0, 1) for gear in ("low", "direct")]
            np.testing.assert_allclose(row, expected, rtol=1e-9)


def test_an_elastic_element_goes_by_its_name() -> None:
    """A gear pair of 20 and 40 teeth between two masses: by ``u = -2`` J2 is J2/4 on link 1."""
    text = """
links: [in, out]
inertias: {in: 0.2, out: 0.8}
elements:
  G: {kind: gear_pair, first: in, second: out, teeth: {first: 20, second: 40}, stiffness: 500}
"""
    made = only(loads(text), "G.stiffness=500,2000", out="omega[1,1], G.compliance")
    expected = [math.sqrt(c * (1 / 0.2 + 4 / 0.8)) for c in (500, 2000)]
    np.testing.assert_allclose(made.columns[:, 0], expected, rtol=1e-12)
    np.testing.assert_allclose(made.columns[:, 1], [1 / 500, 1 / 2000])


@pytest.mark.parametrize(
    "options", [{}, {"zip": True}, {"sample": 12}, {"sample": 12, "method": "lhs"}]
)
def test_ratios_stiffnesses_and_inertias_together(options: dict[str, Any]) -> None:
    case, steps = with_planetary_set(), "" if "sample" in options else ":3"
    varied = [f"{one}{steps}" for one in ("P.ratio=-3:-2", "out.stiffness=1000:5000")]
    out = "omega[1], omega[4], ratio[low]"
    made = only(case, *varied, f"4.inertia=0:0.5{steps}", out=out, **options)
    headings = ["omega[1,low]", "omega[1,direct]", "omega[4,low]", "omega[4,direct]", "ratio[low]"]
    assert list(made.headings) == headings
    for (ratio, stiffness, inertia), row in zip(made.values, made.columns, strict=True):
        one = with_spring(case, "out", stiffness).replace(
            mechanisms=[case.mechanisms[0]._replace(ratio=ratio)],
            inertias={**case.inertias, 4: inertia},
        )
        expected = [alone(one, gear)[mode] for mode in (0, 3) for gear in ("low", "direct")]
        np.testing.assert_allclose(row, [*expected, 1 - ratio], rtol=1e-9)


def two_sets(one: float = -2.0, two: float = -3.0, inertia: float = 0.8) -> Transmission:
    """Two sets with common sun and carrier: with equal ratios their rings turn as one."""
    return Transmission(
        5, [ShiftElement(4, 0, name="B")],
        [Mechanism(1, 2, 3, one, name="one"), Mechanism(1, 4, 3, two, name="two")],
        [Gear([1], name="held"), Gear(name="free")], output=3,
        springs=[
            Spring({2: 1, 4: -1}, stiffness=700.0, name="rings"),
            Spring({3: 1, 5: -1}, stiffness=900.0, name="out"),
        ],
        inertias={1: 0.1, 2: 0.05, 5: inertia},
    )  # fmt: skip


@pytest.mark.parametrize("mode", [1, 2, 3])
def test_ratios_at_which_the_links_are_joined_otherwise(mode: int) -> None:
    """Ratios that all differ go together; 1, and two that are equal, change what is free."""
    rng = np.random.default_rng(mode)
    one = np.append(rng.uniform(-4, -2, 70), [1.0, 1.0, -2.5, -2.5, 1 + 1e-15])
    two = np.append(rng.uniform(-4, -2, 70), [-2.0, 1.0, -2.5, -2.6, -2.0])
    inertia = np.append(rng.uniform(0, 1, 74), 0.0)
    table = {"one.ratio": one, "two.ratio": two, "5.inertia": inertia}
    (made,) = sweep(two_sets(), variants=table, out=f"omega[{mode}]")
    for row, *given in zip(made.columns, one, two, inertia, strict=True):
        expected = [alone(two_sets(*given), gear)[mode - 1] for gear in ("held", "free")]
        np.testing.assert_allclose(row, expected, rtol=1e-9)


def test_expressions_conditions_and_headings() -> None:
    out = "omega[2,1]/omega[1,1], (omega[1,1]/10)**2, max(omega), omega[#2,#1] - omega[2]"
    made = only(NAMED, "damper.stiffness=1190", out=out)
    low, high, *_ = alone(NAMED)
    np.testing.assert_allclose(made.columns[0], [high / low, low**2 / 100, high, 0], atol=1e-9)
    assert made.headings[3] == "(omega[#2,#1] - omega[2])[1]"
    case = NAMED.replace(gears=[Gear(name="a"), Gear(name="2R")])
    made = only(case, "wheel.inertia=1.5", out="omega, omega[1], omega[:,'2R']")
    headings = ["omega[1,a]", 'omega[1,"2R"]', "omega[2,a]", 'omega[2,"2R"]']
    assert list(made.headings) == headings
    np.testing.assert_allclose(made.columns[0], [low, low, high, high], rtol=1e-12)
    made = only(SHAFT, "shaft 1.stiffness=100:1000:10", out="omega", where="omega[1,1] > 60")
    assert made.columns.min() > 60
    assert len(made.variants) == sum(c * 6.25 > 3600 for c in range(100, 1001, 100))


def test_there_is_none_where_a_variant_has_fewer_modes() -> None:
    """Without the inertia of the disc two masses are left; a third mode there is never."""
    made = only(NAMED, "disc.inertia=0,0.01", out="omega[1,1], omega[2,1], omega[3,1]")
    assert np.isnan(made.columns).tolist() == [[False, True, True], [False, False, True]]
    assert statuses(made) == ["ok", "ok"]
    kept = only(NAMED, "disc.inertia=0,0.01", out="omega[1,1]", where="omega[2,1] > 0")
    assert kept.variants.tolist() == [1]
    without = NAMED.replace(inertias={1: 0.15, 3: 1.5})  # which an inertia may bring
    made = only(without, "disc.inertia=0,0.01", out="omega")
    assert made.headings == ("omega[1,1]", "omega[2,1]")


def test_what_no_case_can_have_is_invalid() -> None:
    bad = [0.0, -1.0, math.nan, math.inf, 1e-310]
    for name in ("damper.stiffness", "damper.compliance"):
        (made,) = sweep(NAMED, {name: [500.0, *bad]}, out="omega[1,1]")
        assert statuses(made) == ["ok"] + ["invalid"] * 5
        assert np.isnan(made.columns[1:]).all()
    for name in ("damper.damping", "wheel.inertia"):
        (made,) = sweep(NAMED, {name: [0.0, 1.0, -1.0, math.nan]}, out="omega[1,1]")
        assert statuses(made) == ["ok", "ok", "invalid", "invalid"]
        assert not np.isnan(made.columns[:2]).any()


def test_a_damping_changes_no_frequency() -> None:
    made = only(NAMED, "damper.damping=0,5", out="omega[1,1], damper.damping*2")
    assert made.columns[0, 0] == made.columns[1, 0]
    assert made.columns[:, 1].tolist() == [0, 10]


def test_a_gear_in_which_nothing_can_move_has_none() -> None:
    """A brake and a pair hold the input in `held`: ``omega^2 = c/J`` of the mass on the shaft.

    So it is at any ratio, of many that all differ; another brake holds all the rest in `tied up`.
    """
    held = Transmission(
        3, [ShiftElement(2, name="B"), ShiftElement(3, name="D")],
        [Mechanism(1, 2, 0, -2.0, name="pair")],
        [Gear(name="free"), Gear([1], name="held"), Gear([1, 2], name="tied up")],
        springs=[Spring({2: 1, 3: -1}, stiffness=100.0, name="shaft")],
        inertias={1: 0.1, 2: 0.2, 3: 0.5},
    )  # fmt: skip
    made = only(held, "shaft.stiffness=100,200", out="omega[1]")
    assert statuses(made) == ["tied up"] * 2
    assert np.isnan(made.columns[:, 2]).all()
    np.testing.assert_allclose(made.columns[:, 1] ** 2, [200, 400], rtol=1e-12)
    np.testing.assert_allclose(made.columns[0, 0], alone(held, "free")[0], rtol=1e-12)
    (made,) = sweep(held, {"pair.ratio": -1 - np.arange(200) / 100}, out="omega[1,held]")
    assert set(statuses(made)) == {"ok"}
    np.testing.assert_allclose(made.columns[:, 0] ** 2, 200, rtol=1e-12)
    assert statuses(only(held, "shaft.stiffness=100", out="omega[1,free]")) == ["ok"]


def test_a_soft_support_ties_up_the_mean_speeds_but_no_vibration() -> None:
    supported = SHAFT.replace(springs=[*SHAFT.springs, Spring({1: 1}, stiffness=1.0)])
    assert statuses(only(supported, "S2.stiffness=1,2", out="omega[1,1]")) == ["ok", "ok"]
    both = only(supported, "S2.stiffness=1,2", out="omega[1,1], ratio[1]")
    assert statuses(both) == ["tied up", "tied up"]
    assert not np.isnan(both.columns[:, 0]).any()


@pytest.mark.parametrize("coast", [False, True])
def test_freewheels_hold_as_they_do_at_mean_speeds(coast: bool) -> None:
    """A freewheel holds the carrier when the ring is driven forward through the set."""

    def geared(ratio: float) -> Transmission:
        return Transmission(
            4, [ShiftElement(3, 0, "F", "freewheel")], [Mechanism(1, 2, 3, ratio, name="P")],
            [Gear(name="drive")], output=4, inertias={1: 0.1, 2: 0.05, 3: 0.02, 4: 0.5},
            springs=[Spring({2: 1, 4: -1}, stiffness=800.0, name="shaft")],
        )  # fmt: skip

    ratios = [-3.0, -2.0, 2.5]
    (made,) = sweep(geared(-2.5), {"P.ratio": ratios}, out="omega[1,1]", coast=coast)
    expected = [alone(geared(ratio), coast=coast)[0] for ratio in ratios]
    assert made.columns[:, 0].tolist() == pytest.approx(expected, rel=1e-9, nan_ok=True)
