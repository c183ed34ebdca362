"""Pictures of a run: curves over time, points in the kinematic plan, and their labels.

The run is that of a planetary set whose brake locks, in closed form (V. P. Tarasik, simulation of
planetary gearboxes, 2018, figure 2): constant accelerations up to the lock at .410054 s, and after.
"""

from itertools import pairwise

import numpy as np
import pytest

from tests.chance import each_seed
from tests.commands import CASES
from tests.pictures.drawn import titled
from tests.pictures.test_pictures import overlaps
from tests.shipped import shipped_results
from vstatics import (
    CaseError,
    Gear,
    Mechanism,
    Results,
    ShiftElement,
    Transmission,
    load_scenario,
    loads,
    solve,
)
from vstatics.core.model.parts import SpeedOf
from vstatics.pictures import picture
from vstatics.pictures.drawing.labels import width
from vstatics.pictures.drawing.line_styles import thing_look
from vstatics.pictures.drawing.style import POINTS_PER_MILLIMETRE, Style
from vstatics.pictures.plan.course import course, visited
from vstatics.pictures.plan.rays import plans
from vstatics.pictures.runs import event_text, named_events
from vstatics.simulation import Motion, simulate
from vstatics.simulation.pictures.elements import states
from vstatics.simulation.pictures.events import placed_words
from vstatics.simulation.pictures.lines import thinned
from vstatics.simulation.pictures.panels import panels
from vstatics.simulation.record.asked import TABLES
from vstatics.simulation.record.motion import Energy, Event, EventKind, Peak

LOCK = 34.906585 / 85.126799
"""Slip at the start by its acceleration. [s]"""


@pytest.fixture(scope="module")
def results() -> Results:
    return shipped_results("tarasik-set.yaml")


def run(count: int = 20) -> Motion:
    """The brake slips to `LOCK` and then sticks; the lock-up clutch stays open."""
    before, after = np.linspace(0.0, LOCK, count), np.linspace(LOCK, 1.0, count)
    sun = np.r_[52.359878 - 0.548321 * before, 52.135036 + 25.477707 * (after - LOCK)]
    carrier = np.r_[50.856751 * before, (52.135036 + 25.477707 * (after - LOCK)) / 2.5]
    ring = np.r_[-34.906585 + 85.126799 * before, 0.0 * after]
    time = np.r_[before, after]
    brake = np.r_[np.full(count, -120.0), np.full(count, -60.5)]
    heat = np.r_[858.815102 * (1 - (1 - before / LOCK) ** 2), np.full(count, 858.815102)]
    none = np.zeros_like(time)
    names = ("sun", "ring", "carrier"), ("brake", "lock-up"), ("brake", "lock-up", "set")
    tables = [sun, ring, carrier], [ring, sun - ring], [brake, none, brake / 1.5], [heat, none]
    speeds, slips, torques, heats = (np.stack(table, axis=1) for table in tables)
    energy = Energy(1163.48, {"brake": 858.815102, "lock-up": 0.0}, {}, {}, 304.665, 0.0, 0.0, 0.0)
    events, peaks = (Event(LOCK, "brake", "locks"),), {"brake": Peak(-120.0, 0.0)}
    return Motion(time, *names, speeds, slips, torques, heats, events, energy, peaks)


def test_an_element_slips_until_it_locks_and_what_never_carries_is_left_out() -> None:
    [brake] = states(run())
    assert brake.name == "brake"
    assert np.array(brake.slips) == pytest.approx(np.array([[0.0, LOCK]]))
    assert np.array(brake.sticks) == pytest.approx(np.array([[LOCK, 1.0]]))


def test_panels_have_what_moves(results: Results) -> None:
    shown = {
        panel.text: [name for line in panel.lines for name in line.names]
        for panel in panels(results.case, run())
    }
    of_brake = "slip, rpm", "torque of shift elements, N·m", "heat, kJ"
    assert shown.pop("speed, rpm") == ["sun", "carrier", "ring"]
    assert shown == {name: ["brake"] for name in of_brake}


def test_columns_that_are_asked_for_have_panels_of_their_own(results: Results) -> None:
    none = run().heat[:, 1]
    heat = {"brake": run().heat[:, 0], "lock-up": none, "carrier": none}
    asked = {"slip_power": {"brake": run().slips[:, 0] * -120.0}, "heat": heat}
    found = panels(results.case, run()._replace(asked=asked))
    kinds = [(panel.kind, [name for one in panel.lines for name in one.names]) for panel in found]
    assert kinds[-3:] == [
        ("heat", ["brake"]),
        ("slip_power", ["brake"]),
        ("heat", ["lock-up", "carrier"]),
    ]
    assert found[-1].lines[1].links == (3,)
    assert not found[-3].left_out
    power = found[-2]
    assert power.lines[0].values[0] / power.unit == pytest.approx(34.906585 * 0.12)


def test_each_table_that_can_be_asked_for_can_be_drawn(results: Results) -> None:
    asked = {name: {"brake": run().time} for name in TABLES}
    found = panels(results.case, run()._replace(asked=asked))
    assert len(found) == 4 + len(TABLES) - 1  # heat once


def test_links_of_one_speed_share_a_line(results: Results) -> None:
    speeds = run().speeds[:, [0, 0, 2]]
    speed, *_ = panels(results.case, run()._replace(speeds=speeds))
    assert [line.names for line in speed.lines] == [("sun", "ring"), ("carrier",)]


def test_the_turbine_of_a_converter_is_shown_before_faster_links() -> None:
    text = """springs: {s: {twist: {a: 1, b: 1, c: 1, d: 1}, stiffness: 1}}
converters: {TC: {links: [a, c], points: [[0, 2, 1], [1, 1, 0]]}}"""
    speeds = np.outer(run().time, [3, 9, 2, 1])
    speed, *_ = panels(loads(text), run()._replace(links=tuple("abcd"), speeds=speeds))
    assert "".join(line.names[0] for line in speed.lines) == "adcb"


def test_torques_far_apart_have_panels_of_their_own(results: Results) -> None:
    torques = run().torques.copy()
    torques[:, 1] = 1e5
    found = panels(results.case, run()._replace(torques=torques))
    lines = [panel.lines for panel in found if panel.kind == "torque"]
    assert [[one.names for one in each] for each in lines] == [[("brake",)], [("lock-up",)]]


def test_of_many_events_impacts_and_locks_are_named() -> None:
    events = [Event(0.1 * n, "C", "slips" if n % 2 else "locks") for n in range(8)]
    events[5] = Event(0.5, "C", "impact", 3.0)
    assert named_events(events, 5) == [one for one in events if one.event != "slips"]


def test_steps_of_sequences_are_named_by_their_number() -> None:
    step, locks = Event(0.1, "up", "step", None, "step", 2), Event(0.2, "C", "locks")
    assert [event_text(step, Style(lang)) for lang in ("en", "ru")] == ["up step 2", "up шаг 2"]
    assert named_events([step, locks], 1) == [locks]


def test_a_thinned_line_keeps_ends_and_extremes() -> None:
    time = np.linspace(0.0, 2.0, 200_001)
    values = np.sin(3e3 * time)
    values[77_777] = 5.0
    fewer, kept = thinned(time, values)
    assert (fewer[0], fewer[-1], max(kept)) == (0.0, 2.0, 5.0)
    assert len(fewer) < 7000


def test_a_run_is_on_the_plan_of_what_sticks(results: Results) -> None:
    """The set has two degrees of freedom, so it is always on its plan: from rest to 1/2.5."""
    [(_, through)] = visited(results.case, plans(results), run())
    assert through.on_plan.sum() >= len(through.time) - 4  # those beside the rounded lock
    assert [float(through.output[place]) for place in (0, -1)] == pytest.approx([0.0, 0.4])


def test_a_run_leaves_a_plan_whose_element_slips() -> None:
    """Two sets in a row: the plan of the second brake ends where this slips, from the half on."""
    sets = [Mechanism(1, 2, 3, -2.0), Mechanism(3, 4, 5, -2.0)]
    brakes = [ShiftElement(2), ShiftElement(4), ShiftElement(1, 3)]
    gears = [Gear([1, 2]), Gear([3, 2])]
    case = Transmission(5, brakes, sets, gears, output=5)
    [plan] = plans(solve(case))
    time = np.linspace(0.0, 1.0, 11)
    speeds = np.ones((11, 5))
    speeds[:, 3] = np.where(time < 0.5, 0.0, 0.1)
    motion = run()._replace(time=time, links=("1", "2", "3", "4", "5"), speeds=speeds)
    through = course(case, plan, motion)
    assert through.on_plan.tolist() == (time < 0.5).tolist()
    assert np.isnan(through.masked(through.output, on_plan=True)[time >= 0.5]).all()
    # also that of a link that shall turn twice as fast as another, which turns at 3
    gears = [Gear([one], speeds={4: SpeedOf(3, 2.0)}) for one in (1, 3)]
    case = case.replace(gears=gears)
    [plan] = plans(solve(case))
    speeds *= 3
    speeds[:, 3] += 6
    assert course(case, plan, motion).on_plan.tolist() == (time < 0.5).tolist()


def test_nothing_can_be_drawn_without_a_run_or_where_nothing_moves(results: Results) -> None:
    with pytest.raises(CaseError, match="expected a scenario, not a case"):
        picture(results, "shift", Style())
    still = run()._replace(speeds=0 * run().speeds, torques=0 * run().torques)
    with pytest.raises(CaseError, match="nothing moves"):
        picture(results, "shift", Style(), motion=still)


def test_things_of_a_run_look_different() -> None:
    """Seven colours that no eye mixes up, as of links; then by their dashes."""
    looks = [tuple(map(str, thing_look(n, Style()).values())) for n in range(35)]
    assert len(set(looks)) == len(looks)


def test_a_further_panel_has_what_a_panel_has_no_room_for(results: Results) -> None:
    count = 11
    torques, slip, heat = (
        np.tile(table[:, :1], count) for table in (run().torques, run().slips, run().heat)
    )
    names = tuple(f"C{n}" for n in range(count))
    motion = run()._replace(elements=names, torques=torques, slips=slip, heat=heat)
    slips = [len(one.lines) for one in panels(results.case, motion) if one.kind == "slip"]
    assert slips == [6, 5]


def test_a_bar_says_when_its_element_slips_and_sticks(results: Results) -> None:
    said = [one for one, _ in titled(picture(results, "shift", Style(), motion=run()))]
    assert {"brake slips, 0.000–0.410 s", "brake sticks, 0.410–1.000 s"} <= {*said}


COLUMN = 85 * POINTS_PER_MILLIMETRE
"""Of a journal."""
STYLES = (Style(), Style("ru", dark=True), Style(width=COLUMN))


@pytest.mark.slow
@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize("file", sorted(path.name for path in (CASES / "scenarios").glob("*.yaml")))
def test_no_letters_of_a_shipped_run_cover_others(file: str, style: Style) -> None:
    scenario = load_scenario(CASES / "scenarios" / file)
    assert overlaps(solve(scenario.case), "shift", style, simulate(scenario)) == []


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["shift", "plan"])
@pytest.mark.parametrize("style", STYLES[:2])
@pytest.mark.parametrize("count", [0, 1, 39, 399])
def test_no_word_of_an_event_covers_another(kind: str, style: Style, count: int) -> None:
    """Events without a word are counted below the title."""
    words: tuple[EventKind, ...] = ("locks", "slips", "reverses")
    events = tuple(Event((n + 1) / (count + 1), "brake", words[n % 3]) for n in range(count))
    results = shipped_results("tarasik-set.yaml")
    assert overlaps(results, kind, style, run()._replace(events=events)) == []


@each_seed(20)
def test_words_of_a_row_stand_apart_and_near_their_events(seed: int) -> None:
    rng = np.random.default_rng(seed)
    room = float(rng.uniform(100.0, 400.0))
    places = np.sort(rng.uniform(0.0, room, int(rng.integers(1, 40))))
    kinds = rng.choice(["locks", "slips", "reverses", "impact"], len(places))
    pairs = enumerate(zip(kinds, places, strict=True))
    events = [(Event(n, "C", kind), float(at)) for n, (kind, at) in pairs]
    words = placed_words(events, room, Style())
    assert words
    edges = [(one.middle - width(one.text) / 2, one.middle + width(one.text) / 2) for one in words]
    assert all(left[1] < right[0] for left, right in pairwise(edges))
    assert all(abs(one.middle - one.at) < 80.0 for one in words)
    kept = [one.event for one in words]
    if len(words) < len(events):  # what matters most is named first
        assert any(one.event == "impact" for one in kept) or "impact" not in kinds
