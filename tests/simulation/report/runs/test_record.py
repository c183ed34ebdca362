"""What a page carries of a run: few instants, between which lines draw all of it; all digits.

The run is that of `tests.simulation.pictures.test_shift`, in closed form, or a shipped one.
"""

import base64
import html
import json

import numpy as np
import pytest

from tests.chance import each_seed
from tests.commands import CASES
from tests.shipped import shipped_results
from tests.simulation.pictures.test_shift import LOCK, run
from vstatics import load, load_scenario, simulate, solve
from vstatics.core.numerics.arrays import Floats
from vstatics.pictures.paged.drawn import Drawn
from vstatics.simulation.record.columns import columns
from vstatics.simulation.report.runs.instants import NEAR, chosen_instants
from vstatics.simulation.report.runs.levers import moving_levers
from vstatics.simulation.report.runs.record import page_run, recorded
from vstatics.simulation.report.runs.section import moving_run


def numbers(text: str) -> Floats:
    parts = np.frombuffer(base64.b64decode(text), np.uint8)
    return np.frombuffer(parts.reshape(8, -1).T.tobytes(), "<f8")


@each_seed(5)
def test_lines_between_instants_are_as_near_as_stated(seed: int) -> None:
    """Of random swinging columns with a jump and a gap; what must stay does."""
    chance = np.random.default_rng(seed)
    time = np.sort(np.r_[chance.uniform(0, 1, 400), 0.5, 0.5])
    swings = np.sin(time[:, None] * chance.uniform(2, 40, 4) + chance.uniform(0, 6, 4))
    jump = np.where(np.arange(len(time)) > np.searchsorted(time, 0.5), 3.0, 0.0)
    gap = np.where((time > 0.3) & (time < 0.4), np.nan, 7.0 + time)
    table = np.column_stack([swings * 10.0 ** chance.integers(-9, 9, 4), jump, gap])
    must = tuple(chance.choice(time, 3))
    kept, off = chosen_instants(time, table, 10_000, must)
    assert off <= NEAR
    assert {*must, 0.5, time[0], time[-1]} <= {*time[kept].tolist()}
    assert (time[kept] == 0.5).sum() == 2
    second = np.searchsorted(time, 0.5) + 1
    sides = slice(None, second), slice(second, None)
    for column in table.T[:-1]:
        assert np.nanmax(column[kept]) == np.nanmax(column)
        assert np.nanmin(column[kept]) == np.nanmin(column)
        for side in sides:
            drawn = np.interp(time[side], time[side][kept[side]], column[side][kept[side]])
            assert np.abs(drawn - column[side]).max() <= off * np.ptp(column) * (1 + 1e-9)
    edges = np.flatnonzero(np.diff(np.isnan(gap)))
    assert kept[edges].all()
    assert kept[edges + 1].all()
    few, further = chosen_instants(time, table, 30, must)
    assert few.sum() < kept.sum()
    assert further >= off


def test_columns_have_all_digits_of_the_run_at_its_instants() -> None:
    """By the headings of `vstatics simulate -f csv`; what does not change is a single number."""
    motion, results = run(), shipped_results("tarasik-set.yaml")
    kept = page_run(results, motion).motion
    told = recorded(results, kept)
    assert numbers(told["time"]).tolist() == kept.time.tolist()
    known, named = columns(motion), {}
    for panel in told["panels"]:
        for line in panel["lines"]:
            named[line["heading"]] = numbers(told["columns"][line["column"]])
    speeds = {f"speeds[{link}]" for link in motion.links}
    assert named.keys() == speeds | {"slips[brake]", "torques[brake]", "heat[brake]"}
    for heading, values in named.items():
        if heading in known:  # all but heat
            drawn = np.broadcast_to(values, kept.time.shape)
            there = {*zip(motion.time, known[heading], strict=True)}
            assert {*zip(kept.time, drawn, strict=True)} <= there
    brake, lock_up = told["elements"]
    assert numbers(told["columns"][lock_up["torque"]]).tolist() == [0.0]
    found = [brake[key] for key in ("name", "slips", "sticks")]
    assert found == ["brake", ((0.0, LOCK),), ((LOCK, 1.0),)]
    assert told["events"] == [{"time": LOCK, "told": "brake locks"}]


def test_a_line_needs_no_more_instants_than_it_bends_at() -> None:
    """Speeds are straight up to the lock, where torques jump; the heat is a parabola."""
    results, long = shipped_results("tarasik-set.yaml"), run(2000)
    straight = long._replace(heat=0.0 * long.heat, energy=long.energy._replace(heat={"brake": 0.0}))
    assert page_run(results, straight).motion.time.tolist() == [0.0, LOCK, LOCK, 1.0]
    bent = len(page_run(results, long).motion.time)
    chords = np.sqrt(1 / (4 * NEAR))  # of a parabola over its range each is off by 1 / (4 n^2)
    assert chords < bent < 2 * chords + 2


@pytest.mark.parametrize("name", ["gf4a-upshifts", "8l90-shifts"])
def test_events_and_states_stay_as_they_were(name: str) -> None:
    """A run with few instants still tells when its elements slip and stick."""
    scenario = load_scenario(CASES / "scenarios" / f"{name}.yaml")
    motion, results = simulate(scenario, step=scenario.duration / 400), solve(scenario.case)
    kept = page_run(results, motion)
    assert len(kept.motion.time) < 0.6 * len(motion.time)
    assert kept.off <= NEAR
    whole, few = recorded(results, motion), recorded(results, kept.motion)
    assert few["gears"] == whole["gears"]
    assert few["events"] == whole["events"]
    step = scenario.duration / 400
    for one, other in zip(few["elements"], whole["elements"], strict=True):
        for kind in ("slips", "sticks"):
            edges, others = np.ravel(one.get(kind, ())), np.ravel(other.get(kind, ()))
            assert edges == pytest.approx(others, abs=2 * step), (one["name"], kind)


def test_names_end_nothing_of_the_page() -> None:
    case = load(CASES / "tarasik-set.yaml")
    nasty = '</div>"<script>'
    motion = run()._replace(elements=(nasty, "lock-up"), devices=(nasty, "lock-up", "set"))
    motion = motion._replace(energy=motion.energy._replace(heat={nasty: 858.8}), peaks={})
    shown = moving_run(solve(case), motion, Drawn("stick", [], "none"))
    assert "<script" not in shown
    data = shown.partition('data-record="')[2].partition('"')[0]
    assert json.loads(html.unescape(data))["elements"][0]["name"] == nasty


def test_a_case_without_levers_has_none() -> None:
    assert list(moving_levers(load(CASES / "moskvich-start.yaml"))) == []
