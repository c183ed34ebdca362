"""Letters of pictures of runs: none over another, and words near their events."""

from itertools import pairwise

import numpy as np
import pytest

from tests.chance import each_seed
from tests.commands import CASES
from tests.pictures.test_pictures import overlaps
from tests.shipped import shipped_results
from tests.simulation.pictures.test_shift import run
from vstatics import load_scenario, solve
from vstatics.pictures.drawing.labels import width
from vstatics.pictures.drawing.style import POINTS_PER_MILLIMETRE, Style
from vstatics.simulation.pictures.events import placed_words
from vstatics.simulation.record.motion import Event, EventKind
from vstatics.simulation.run import simulate

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
