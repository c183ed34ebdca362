"""A scenario as tests of its sweeps have it: a set whose brake closes, from tarasik.md's example.

The brake of the ring locks at .410054006 s; see `cases/scenarios/tarasik-set-lock.yaml`.
"""

from vstatics import VariedScenario
from vstatics.sweep.variants.subject import Document

CASE = b"""\
links: [sun, ring, carrier]
inertias: {sun: 0.5, ring: 0.7, carrier: 0.8}
mechanisms: {set: {first: sun, second: ring, third: carrier, ratio: -1.5}}
shift_elements: {brake: [ring, housing], lock-up: [sun, ring]}
gears: {"1": {engaged: [brake]}, "2": {engaged: [lock-up]}}
"""
SCENARIO = b"""\
case: set.yaml
duration: 0.6
start: {speeds: {sun: 500 rpm, carrier: 0}}
controls:
  brake: [[0, 120]]
  lock-up: "0*t"
torques: {sun: 40, carrier: -60}
targets: {carrier: [10, 20]}
samples:
  controls.brake.scale: {normal: [1, 0.05]}
  torques.sun: {uniform: [35, 45]}
"""


def subject(scenario: bytes = SCENARIO, case: bytes = CASE) -> VariedScenario:
    """The scenario, as a sweep has it."""
    return VariedScenario(Document(scenario, "lock.yaml"), Document(case, "set.yaml"))
