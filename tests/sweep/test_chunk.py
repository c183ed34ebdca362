"""A part of a sweep: its numbers are those of `solve`, its status the worst of its gears."""

from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from tests.commands import MZKT
from tests.core.statics.test_freewheels import pair
from tests.sweep.sweeps import DIFFERENTIAL, plan
from vstatics import Gear, Mechanism, ShiftElement, Transmission, load, solve
from vstatics.core.jobs.piece_file import Account, Noticed
from vstatics.sweep import blocks, sweep
from vstatics.sweep.chunk import STATUS, noticed_in


def test_numbers_are_those_of_the_case_solved_alone() -> None:
    """Each row against `solve` of one case with these numbers, the engine of `run`."""
    case = load(MZKT)
    random = np.random.default_rng(3)
    ratios, etas = random.uniform([-0.9, 0.9], [-0.7, 1], (30, 2)).T
    table = {"D1.ratio": ratios, "D3.efficiency": etas}
    (made,) = sweep(case, variants=table, out="ratio, efficiency, lossy_torques[T4]")
    assert made.headings[:2] == ("ratio[1]", "ratio[2]")
    assert made.headings[-1] == "lossy_torques[T4,6]"
    for row in range(30):
        own, eta = [ratios[row], 2.6, -2.461], [0.94, 0.95, etas[row]]
        alone = solve(case, ratios=own, efficiencies=eta)
        expected = [*alone.ratio, *alone.efficiency, *alone.lossy_torques[:, 3]]
        np.testing.assert_allclose(made.columns[row], expected, rtol=1e-11)
        assert made.values[row].tolist() == [table[name][row] for name in table]


def statuses(case: Transmission, vary: dict[str, Any], **asked: Any) -> list[str]:
    (made,) = sweep(case, variants=vary, **asked)
    return [STATUS[code] for code in made.status]


def test_a_number_that_can_be_none_makes_an_invalid_row() -> None:
    """0, and what is not finite; an efficiency outside 0 < e <= 1."""
    ratios = [-np.inf, 0, np.nan, np.inf, -2.5, -2.5, -2.5]
    table = {"D.ratio": ratios, "D.efficiency": [0.9, 0.9, 0.9, 0.9, 0, 1.01, 0.9]}
    assert statuses(DIFFERENTIAL, table) == ["invalid"] * 6 + ["ok"]
    (made,) = sweep(DIFFERENTIAL, variants=table)
    assert dict(made.counts) == {"ok": 1, "invalid": 6}
    assert np.isnan(made.columns[:6]).all()
    np.testing.assert_array_equal(made.values[:, 0], ratios)
    frame = made.to_dataframe()
    assert list(frame.columns[:3]) == ["D.ratio", "D.efficiency", "status"]
    assert frame["status"].tolist() == ["invalid"] * 6 + ["ok"]
    assert frame.loc[6, "ratio[low]"] == 3.5
    (kept,) = sweep(DIFFERENTIAL, variants=table, where="not (ratio[low] > 99)")
    assert kept.variants.tolist() == [6]
    assert dict(kept.counts) == dict(made.counts)


def test_the_status_of_a_variant_is_that_of_its_gears() -> None:
    """A pair of ratio 1 is not tied up; at a ratio below 0 its freewheel is driven backward."""
    one = Transmission(2, [], [Mechanism(1, 2, 0, -2, name="D")], [Gear()], output=2)
    (made,) = sweep(one, {"D.ratio": [1, 3]}, out="ratio")
    assert made.columns[:, 0].tolist() == [1, 3]
    assert statuses(pair(2.0), {"D1.ratio": [2, -2]}, out="ratio") == ["ok", "conflict"]


def test_a_gear_that_is_tied_up_or_open_by_its_ratios_tells_so() -> None:
    """Two sets side by side between links 1 and 2 agree for equal ratios only.

    Then one of them is in excess; with others they hold the train.
    """
    for ratio, name, varied in ((-2, "A", [-2, -3]), (-3, "B", [-2, -3])):
        sets = [Mechanism(1, 2, 0, -2, name="A"), Mechanism(1, 2, 0, ratio, name="B")]
        case = Transmission(2, [], sets, [Gear()], output=2)
        assert statuses(case, {f"{name}.ratio": varied}, out="ratio") == ["ok", "tied up"]
    # of three links the two sets fix all speeds, but not if they say the same
    sets = [Mechanism(1, 2, 3, -2, name="A"), Mechanism(1, 2, 3, -3, name="B")]
    case = Transmission(3, [], sets, [Gear()])
    assert statuses(case, {"B.ratio": [-3, -2]}, out="ratio") == ["ok", "open"]
    # on two links of their own, where no torque is
    sets = [Mechanism(3, 4, 0, -2, name="A"), Mechanism(3, 4, 0, -3, name="B")]
    case = Transmission(4, [], [Mechanism(1, 2, 0, -2), *sets], [Gear()], output=2)
    assert statuses(case, {"B.ratio": [-3, -2]}, out="ratio") == ["ok", "open"]


def test_a_neutral_gear_of_the_case_is_no_reason() -> None:
    sets = [Mechanism(1, 2, 3, -2, name="D")]
    case = Transmission(3, [ShiftElement(2)], sets, [Gear(), Gear([1])])
    (made,) = sweep(case, {"D.ratio": [-2, -3]}, out="ratio")
    assert made.status.tolist() == [0, 0]
    assert np.isnan(made.columns[:, 0]).all()
    assert made.columns[:, 1].tolist() == [3, 4]


@pytest.mark.parametrize("jobs", [1, 2])
def test_chunks_come_in_order_and_join_to_the_whole(jobs: int) -> None:
    chunks = list(sweep(DIFFERENTIAL, {"D.ratio": "-4:-2:70000"}, out="ratio[low]", jobs=jobs))
    assert [made.start for made in chunks] == [0, 65536]
    assert np.concatenate([made.variants for made in chunks]).tolist() == list(range(70000))
    numbers = np.concatenate([made.columns for made in chunks])[:, 0]
    np.testing.assert_allclose(numbers, 5 - np.arange(70000) / 69999 * 2, rtol=1e-12)


def test_blocks_are_of_a_size_that_the_case_tells() -> None:
    """MZKT has 6 gears: tens of megabytes hold about ten thousand of its variants."""
    ends = list(blocks.blocks(load(MZKT), 65536, 131072))
    assert ends[0][0] == 65536
    assert ends[-1][1] == 131072
    assert all(256 <= stop - start <= 16384 for start, stop in ends)
    assert all(one[1] == other[0] for one, other in pairwise(ends))
    sizes = [(stop - start) * blocks.variant_bytes(load(MZKT)) for start, stop in ends]
    assert max(sizes) <= blocks.BLOCK_BYTES
    results = solve(load(MZKT), ratios=np.tile([-0.8, 2.6, -2.461], (10, 1)))
    arrays = [array for array in results if isinstance(array, np.ndarray)]
    size = sum(array.nbytes for array in arrays) / 10
    assert blocks.variant_bytes(load(MZKT)) == pytest.approx(size, rel=0.1)


def test_conventions_of_the_call_come_before_those_of_the_case() -> None:
    """Coasting turns the flow, so the efficiency is that of `solve(coast=True)`."""
    (made,) = sweep(DIFFERENTIAL, {"D.ratio": [-2.5]}, coast=True)
    expected = solve(DIFFERENTIAL, coast=True)
    np.testing.assert_allclose(made.columns[0], [*expected.ratio, *expected.efficiency])


def test_a_fingerprint_tells_plans_apart() -> None:
    vary = "D.ratio=-4:-2:9"
    same: dict[str, Any] = {"piece": 8, "out": "ratio", "where": "ratio[low] > 3"}
    plans = [plan(one, **same) for one in (vary, "D.ratio=-4:-2:10", "D.ratio=-4:-2.1:9")]
    plans += [plan("D.efficiency=.9:1:9", **same)]
    plans += [plan("D.ratio=-4:-2", sample=9, **{**same, "seed": seed}) for seed in (None, 1)]
    others: list[dict[str, Any]] = [
        *({"piece": 9}, {"out": "efficiency"}, {"where": "ratio[low] > 4"}, {"coast": True}),
        *({"min": ["ratio[low]"]}, {"max": ["ratio[low]"]}, {"max": ["ratio[low]"], "best": 3}),
    ]
    plans += [plan(vary, **{**same, **other}) for other in others]
    assert len({made.fingerprint() for made in plans}) == len(plans)
    assert plan(vary, **same).fingerprint() == plans[0].fingerprint()
    assert plans[0].fingerprint("csv") != plans[0].fingerprint("jsonl")


def test_what_cannot_be_is_reported_before_anything_is_calculated() -> None:
    wrong: list[tuple[dict[str, Any], str]] = [
        ({"vary": {"D.ratio": [[1.0]]}}, "D.ratio: read 2 axes"),
        ({"variants": {"D.ratio": [1], "D.efficiency": [1, 2]}}, "the same number of values"),
        ({"vary": {"D.ratoi": [1]}}, "did you mean `ratio`"),
        ({"vary": ["D.ratio=1"], "out": "ratoi"}, "did you mean `ratio`"),
    ]
    for arguments, words in wrong:
        with pytest.raises(Exception, match=words):
            sweep(DIFFERENTIAL, **arguments)


def test_messages_that_differ_in_numbers_are_counted_together() -> None:
    """With the words of the first variant, whichever piece comes first."""
    both = Noticed("W1", "slip of 2.5", 7, 3), Noticed("W1", "slip of 4", 2, 5)
    parts = [Account(piece, 0, {}, (), noticed=(one,)) for piece, one in enumerate(both)]
    assert noticed_in(parts) == (Noticed("W1", "slip of 4", 2, 3 + 5),)
