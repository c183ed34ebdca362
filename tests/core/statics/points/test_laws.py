"""Losses that depend on speed and torque: closed forms, each point alone, exact fractions."""

import math
import pickle
from fractions import Fraction
from itertools import product
from typing import Any

import numpy as np
import pytest

from tests.chance import ranges_with_slow, seeded
from tests.core.statics.test_drag import nearest
from tests.oracle.drag import solve_gear
from tests.oracle.systems import Speeds
from tests.trains import is_regular, random_train
from vstatics import CaseError, Gear, Load, Mechanism, Transmission, solve
from vstatics.core.model.laws import MapLaw, PointLaw
from vstatics.core.model.parts import OfLoad
from vstatics.core.numerics.traced import plain
from vstatics.core.readers import loads
from vstatics.core.readers.named.law_formulas import DragFormula

RPM = 30 / math.pi
LOAD = Load(1000, 100)

MAP_OF_PAIR = "[speed, torque], columns: [0, 100], rows: [[0, 0.1, 0.1], [100, 0.5, 0.9]]"


def pair(load: Load | None = LOAD, efficiency: Any = 1.0, **own: Any) -> Transmission:
    mechanism = Mechanism(1, 2, 0, -2.5, efficiency, name="pair")
    return Transmission(2, [], [mechanism], [Gear(**own)], load=load)


def test_ratios_vary_beside_laws() -> None:
    case = pair(Load(200 * RPM, 80), drag={2: DragFormula("1 + 0.01*w")})
    found = solve(case, ratios=[[-2], [-3]])
    expected = [1 - (1 + 0.01 * 200 / u) / (80 * u) for u in (2, 3)]
    np.testing.assert_allclose(found.efficiency[:, 0], expected, rtol=1e-13)


def test_outside_its_points_a_law_is_constant_and_a_note_says_so() -> None:
    """Of the gears only the one with the law, of the speeds only those above 100 rad/s."""
    gears = [Gear(drag={1: PointLaw([(0, 1), (100, 3)])}), Gear()]
    case = pair(Load(400 * RPM, 100)).replace(gears=gears, link_names=["engine", "out"])
    results = solve(case)
    assert results.efficiency == pytest.approx([0.97, 1])
    assert [one.id for one in results.messages] == ["N414"]
    assert solve(case.replace(allow=["N414"])).messages == ()
    free = case.replace(links=3, output=3, link_names=["engine", "gear", "out"])  # without torques
    assert "N414" not in [one.id for one in solve(free).messages]
    points = solve(case, vary={"load.speed": [50, -101, 100, 400]}).points
    assert points is not None
    assert {name: at.T.tolist() for name, at in points.outside.items()} == {
        "engine (0 to 954.93 rpm)": [[False, True, False, True], [False] * 4]
    }


@pytest.mark.parametrize("speed", [1500, 1789, 4500])
def test_a_point_at_the_edge_of_a_map_is_inside_in_spite_of_rounding(speed: int) -> None:
    """A ratio of 2.8 and an efficiency of 0.97 lead to a corner of the second map."""
    behind = MapLaw([0, 33.3 * 2.8 * 0.97], [[speed / RPM / 2.8, 0.9, 0.9], [9999, 0.9, 0.9]])
    mechanisms = [Mechanism(1, 2, 0, -2.8, 0.97), Mechanism(2, 3, 0, -1.7, behind)]
    loss = MapLaw([0, 33.3], [[0, 0, 0], [speed / RPM, 0, 0]], "kW")
    case = Transmission(3, [], mechanisms, [Gear(loss=loss, name="low")], load=Load(speed, 33.3))
    assert solve(case).messages == ()
    [said] = solve(case.replace(load=Load(speed, 33.4))).messages
    assert (said.id, "the loss of gear low (" in said.text) == ("N414", True)


def test_laws_that_cannot_be_are_refused() -> None:
    for law, said in (
        (PointLaw([(1, 1), (0, 2)]), "read 0 rad/s, expected a speed above 1 rad/s"),
        (PointLaw([(0, -1)]), "read -1, expected a torque of 0 or more"),
        (PointLaw([(-5, 1)]), "read -5 rad/s, expected a speed of 0 or more"),
    ):
        with pytest.raises(CaseError, match=said):
            pair(drag={1: law})
    with pytest.raises(CaseError, match=r"loss.*: read -7, expected a loss of 0 or more"):
        pair(loss=MapLaw([0, 9], [[0, 1, 1], [9, 1, -7]], "W"))
    case = pair(Load(200 * RPM, 80), drag={1: DragFormula("1 - 0.01*w")})
    with pytest.raises(CaseError, match=r"drag of 1: read -1, expected a torque of 0 or more"):
        solve(case)
    with pytest.raises(CaseError, match=r"gears\[1\].drag\[1\]: it depends .* has no torque"):
        solve(pair(Load(1000), drag={1: PointLaw([(0, 1)])}))
    with pytest.raises(CaseError, match=r"mechanisms\[1\].efficiency: it depends"):
        solve(pair(None, PointLaw([(0, 0.9)])))


def test_a_law_is_taken_for_no_number_and_survives_another_process() -> None:
    points, formula = PointLaw([(0, 2), (300, 3.5)]), DragFormula("2 + 0.005*w")
    assert points not in (2, formula, PointLaw([(0, 2), (300, 3.5)], "torque"))
    for law in (points, formula):
        copied = pickle.loads(pickle.dumps(law))  # noqa: S301
        assert (copied, hash(copied)) == (law, hash(law))
        assert repr(law) != repr(float(law))


def of_random_laws(seed: int) -> Transmission:
    """A random train of regular gears with laws: two links, all open elements, one efficiency."""
    random = seeded(seed)
    case = random_train(random, regular=True, coast=False).replace(load=Load(1500, 100))
    first, *others = case.mechanisms
    open_drag = PointLaw([(0, 0), (200, 2)])
    links = random.sample(range(1, case.links + 1), 2)
    laws = DragFormula("0.5 + 0.002*w"), PointLaw([(0, 1), (250, 1.5)])
    drag = dict(zip(links, laws, strict=True))
    return case.replace(
        mechanisms=[first._replace(efficiency=PointLaw([(0, 0.9), (500, 0.98)])), *others],
        shift_elements=[one._replace(drag=open_drag) for one in case.shift_elements],
        gears=[gear._replace(drag=drag) for gear in case.gears],
    )


def exact_gear(case: Transmission, gear: Gear, speed: float, torque: float) -> Any:
    """All sets of signs in fractions, with laws asked at the exact speeds."""
    moves = Speeds(case, gear)

    def asked(law: Any, first: int, second: int) -> float:
        slip = moves.difference(first, second)
        assert slip is not None
        return float(law.at(float(abs(slip)) * speed))

    first, *others = case.mechanisms
    efficiency = asked(first.efficiency, first.first, first.third)
    elements = [*enumerate(case.shift_elements, 1)]
    opened = {n: asked(one.drag, one.first, one.second) / torque for n, one in elements}
    drag = {link: asked(law, link, 0) / torque for link, law in gear.drag.items()}
    plain = case.replace(
        mechanisms=[first._replace(efficiency=efficiency), *others],
        shift_elements=[one._replace(drag=0.0) for _, one in elements],
        gears=[gear._replace(drag={})],
    )
    return solve_gear(plain, gear._replace(drag=drag, open_drag=opened))


@ranges_with_slow(4, 24, 200)
def test_points_of_random_trains_agree_with_all_sets_of_signs(seeds: range) -> None:
    """From torques that drag takes in all up to large ones: dragged, locked and ordinary."""
    seen = set()
    speed, torque = np.array([30.0, 150, 400, 400]), np.array([2.0, 8, 40, 250])
    for case in map(of_random_laws, seeds):
        found = solve(case, vary={"load.speed": speed, "load.torque": torque})
        for number, point in product(range(len(case.gears)), range(4)):
            if not is_regular(case, case.gears[number]):
                continue
            exact = exact_gear(case, case.gears[number], speed[point], torque[point])
            states = bool(found.locked[point, number]), bool(found.dragged[point, number])
            seen.add(states)
            torques = found.lossy_torques[point, number]
            if nearest(exact, states, torques[-1]):
                assert abs(found.power_balance[point, number]) < 1e-12 * (1 + np.abs(torques).max())
    assert len(seen) > 1


TORQUES = """\
links: [s, r, c]
input: c
output: s
load: {{speed: 1000 rpm, torque: 60 N*m}}
shift_elements: {{B: [r, housing]}}
mechanisms:
  set: {{first: s, second: r, third: c, ratio: -2, efficiency: {{over: torque, points: {points}}}}}
gears: {{a: [B]}}
"""


def test_where_two_torques_agree_there_are_none_and_a_message_says_so() -> None:
    """M = 60/(1 + 2/eta) is 7.8 at .3 and 19.3 at .95, where both hold.

    It is 10 at .4, and meets the fall from .95 to .3 about 14.5: the steep rise between them is
    narrower than the net of guesses, and in the fall passes jump to and fro.
    """
    for points in (
        "[[0, .3], [12, .3], [13, .95], [100, .95]]",
        "[[0, .4], [10.005, .4], [10.2, .95], [14, .95], [15, .3]]",
    ):
        results = solve(loads(TORQUES.format(points=points)))
        assert np.isnan([*results.lossy_torques[0], *results.efficiency]).all()
        assert not np.isnan(results.torques).any()
        [said] = [one for one in results.messages if one.id != "N414"]
        assert (said.id, "more than one torque" in said.text) == ("W426", True)
        state = results.gear(1)
        assert state.status.name == results.status(1).name == "undecided"
        assert all(math.isnan(plain(one)) for one in state.lossy_torques.on_first_link)


def test_where_nothing_holds_the_torque_no_law_is_blamed() -> None:
    """A neutral gear is out of balance with constant efficiencies; with a law it is no other."""
    case = loads(TORQUES.format(points="[[0, .3], [100, .95]]").replace("[B]}", "[B], n: []}"))
    constant = case.replace(mechanisms=[case.mechanisms[0]._replace(efficiency=0.5)])
    results = solve(case)
    assert [one.id for one in results.messages] == [one.id for one in solve(constant).messages]
    assert results.undecided.tolist() == [False, False]
    assert not np.isnan(results.efficiency[0])


def test_an_efficiency_that_falls_steeply_is_found_by_halves() -> None:
    """Passes jump to and fro; M = 60/(1 + 2/eta) meets eta = .95 - .65 (M - 12) near 12.5."""
    points = "[[0, .95], [12, .95], [13, .3], [100, .3]]"
    results = solve(loads(TORQUES.format(points=points)))
    torque = results.lossy_torques_Nm[0, -1]
    assert torque == pytest.approx(60 / (1 + 2 / (0.95 - 0.65 * (torque - 12))), rel=1e-12)
    assert 12 < torque < 13
    assert results.messages == ()


def test_freewheels_hold_as_the_drags_of_their_own_state_let_them() -> None:
    """With the numbers that laws come to the same freewheels hold, or there is no state."""
    law = PointLaw([(0, 0), (200, 6)])
    for seed in (1, 3, 5, 8, 29):
        random = seeded(seed)
        case = random_train(random, coast=False).replace(load=Load(1500, 100))
        wheels = [n for n in range(1, len(case.shift_elements) + 1) if random.random() < 0.4]
        elements = [
            one._replace(drag=law, kind="freewheel" if n in wheels else one.kind)
            for n, one in enumerate(case.shift_elements, 1)
        ]
        gears = [g._replace(engaged=[n for n in g.engaged if n not in wheels]) for g in case.gears]
        with_laws = case.replace(shift_elements=elements, gears=gears)
        results = solve(with_laws)
        for index, gear in enumerate(with_laws.gears):
            slips = np.nan_to_num(np.abs(results.slip_speeds[index])) * 1500 / RPM
            drags = {n: OfLoad(law.at(slip), 1.0) for n, slip in enumerate(slips, 1)}
            alone = solve(with_laws.replace(gears=[gear._replace(open_drag=drags)]))
            if results.undecided[index] and not alone.undecided[0]:
                assert np.isnan(results.lossy_torques[index]).all()
                continue
            assert results.holds[index].tolist() == alone.holds[0].tolist()
            expected = alone.lossy_torques[0]
            size = max(1.0, float(np.abs(np.nan_to_num(expected)).max()))
            np.testing.assert_allclose(results.lossy_torques[index], expected, atol=1e-11 * size)


DRIVE = """\
links: [a, b, c]
output: c
load: {speed: 1200 rpm, torque: 100 N*m}
elements:
  G: {kind: gear_pair, first: a, second: b, teeth: {first: 20, second: 40}, efficiency: PAIR}
  P: {kind: planetary, sun: b, ring: housing, carrier: c, teeth: {sun: 30, ring: 78},
      efficiency: SET}
gears: {drive: []}
"""
OVER_TORQUE = DRIVE.replace("PAIR", "{over: torque, points: [[0, .9], [150, .975]]}")
OVER_TORQUE = OVER_TORQUE.replace("SET", "{over: torque, points: [[0, .9], [300, .98]]}")


def over_torque(torque: Fraction) -> Fraction:
    """The pair has .9 + torque/2000 up to 150 N*m; the sun gets twice as much less its loss.

    With the sun driving, the ring has 2.6 eta of its torque, the carrier 1 + 2.6 eta, of 3.6.
    """
    first = min(Fraction(9, 10) + torque / 2000, Fraction(975, 1000))
    sun = 2 * torque * first
    second = min(Fraction(9, 10) + Fraction(8, 100) * sun / 300, Fraction(98, 100))
    return first * (1 + Fraction(26, 10) * second) / Fraction(36, 10)


def test_an_efficiency_of_a_gear_set_depends_on_its_first_member() -> None:
    """Its torque, or its speed against the third: the sun turns with 20 pi rad/s at 1200 rpm."""
    torques = np.array([1.0, 40.0, 100.0, 149.0, 200.0, 900.0])
    found = solve(loads(OVER_TORQUE), vary={"load.torque": torques})
    expected = [float(over_torque(Fraction(int(torque)))) for torque in torques]
    np.testing.assert_allclose(found.efficiency[:, 0], expected, rtol=1e-12)
    assert (np.abs(found.power_balance) <= 1e-12).all()
    points = "{over: speed, points: [[0, .9], [100, 1]]}"
    results = solve(loads(DRIVE.replace("PAIR", "1").replace("SET", points)))
    second = 0.9 + 0.001 * 20 * np.pi * (1 - 1 / 3.6)
    assert results.efficiency[0] == pytest.approx((1 + 2.6 * second) / 3.6, rel=1e-13)
    with pytest.raises(CaseError, match="gear drive has no speed") as caught:
        solve(loads(OVER_TORQUE.replace("speed: 1200 rpm, ", "")))
    path, _ = [problem.path for problem in caught.value.problems if problem.id == "E267"]
    assert path == ("mechanisms", 1, "efficiency")


@pytest.mark.parametrize("left", [70.0, 50.0, 10.0, 1e-3, 1e-8, -1e-3, -10.0])
@pytest.mark.parametrize("law", ["torque, points: [[0, 0.5], [100, 0.9]]", MAP_OF_PAIR])
def test_a_freewheel_can_open_at_trial_efficiencies(law: str, left: float) -> None:
    """At 80 N*m the pair has 0.82, and 2 * 80 * 0.82 N*m less the drag is left for the output."""
    case = loads(f"""
    links: [input, mid, output]
    load: {{speed: 1000 rpm, torque: 80 N*m}}
    shift_elements: {{F: {{kind: freewheel, links: [output, mid]}}}}
    mechanisms: {{pair: {{first: input, second: mid, ratio: 2, efficiency: {{over: {law}}}}}}}
    drag: {{mid: {2 * 80 * 0.82 - left!r} N*m}}
    gears: {{"1": []}}
    """)
    expected = left if left > 0 else math.nan
    [torque] = solve(case).lossy_output_torque_Nm
    assert torque == pytest.approx(expected, rel=1e-9, abs=1e-12, nan_ok=True)
