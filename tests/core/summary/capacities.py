"""A case with capacities and a load."""

from vstatics import Transmission
from vstatics.core import readers

CASE = """\
links: 3
load: {speed: 1000 rpm, torque: 200 N*m}
shift_elements:
  C: {links: [1, 2], capacity: 300 N*m}
  B: {links: [2, housing], capacity: 3}
mechanisms: {D: {first: 1, second: 2, third: 3, ratio: -2.5, efficiency: 0.96}}
gears:
  low: {engaged: [B]}
  creep: {engaged: [B], load: {torque: 100 N*m}}
  direct: {engaged: [C], load: {speed: 2000 rpm}}
  N: {}
"""


LOW = 3.4 / 3.5


def case(text: str = CASE) -> Transmission:
    return readers.read(text.encode(), "case.yaml").case
