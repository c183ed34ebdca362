"""Speeds of vehicles in conditions: a wheel reaches them as its target of the same speed."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.chance import count, seeded
from vstatics.core.errors import ReadError
from vstatics.simulation import load_scenario, simulate

CASE = "{links: [wheel, other], inertias: {wheel: 90, other: 1}}"
UNITS = {"km/h": 1 / 3.6, "mph": 0.44704, "m/s": 1.0}
"""In m/s; 1 mile is 1609.344 m (International Yard and Pound, 1959)."""


def scenario(folder: Path, when: str, radius: float, torque: float = 200.0) -> Path:
    """A wheel that a constant torque speeds up from rest, without resistance."""
    (folder / "case.yaml").write_text(CASE)
    file = folder / "run.yaml"
    file.write_text(f"""
case: case.yaml
duration: 100
start: {{speeds: {{wheel: 0, other: 0}}}}
torques: {{wheel: [{torque!r}, {{road: {{mass: 1000, radius: {radius!r}}}}}]}}
set: {{seen: 0}}
sequences: {{s: [{{when: "{when}", set: {{seen: 1}}}}]}}
""")
    return file


@pytest.mark.parametrize("seed", range(count(20, 300)))
def test_a_condition_is_met_when_the_vehicle_has_its_speed(seed: int, tmp_path: Path) -> None:
    """Constant acceleration: w = M t/J, and the vehicle has v = r w."""
    rng = seeded(4900 + seed)
    radius, unit = rng.uniform(0.2, 0.6), rng.choice(list(UNITS))
    speed = rng.randint(1, 40)
    forms = [
        f"speed('wheel') > {speed} {unit}",
        f"{speed}{unit} < speed('wheel')",
        f"abs(speed('wheel')) >= {speed} {unit} and t > 0",
        f"-speed('wheel') < -{speed} {unit}",
        f"0 km/h < {speed} {unit} < speed('wheel')",
    ]
    run = simulate(load_scenario(scenario(tmp_path, rng.choice(forms[:4]), radius)))
    [event] = run.events
    assert event.time == pytest.approx(speed * UNITS[unit] / radius * 90 / 200, rel=1e-9)


@pytest.mark.parametrize(
    ("when", "said"),
    [
        ("speed('other') > 5 km/h", "next to speed.. of a link with a `road`; links .*: wheel"),
        ("t > 5 mph", "read `5 mph`, the speed of a vehicle, expected it next to speed"),
        ("speed('wheel') > 5 km/h + 3 km/h", "alone on one side of a comparison"),
        ("speed('wheel') > 5 kg", "read `kg` after `5`, expected an operator"),
    ],
)
def test_other_speeds_are_refused(when: str, said: str, tmp_path: Path) -> None:
    with pytest.raises(ReadError, match=f"run.yaml:7:.*{said}"):
        load_scenario(scenario(tmp_path, when, 0.3))
