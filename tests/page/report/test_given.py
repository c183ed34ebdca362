"""The input of a case as tables: laws, and how shift elements and springs slip."""

from vstatics import loads
from vstatics.page.report.given import _mechanisms, _shift_elements, torsion_grids

SLIPPING = """
inertias: {a: 1, b: 2, c: 3}
shift_elements:
  C: {links: [a, b], static: 1.2}
  D: {links: [a, b], friction: {radius: .1, area: 60e-4, surfaces: 8, coefficient: [[0, .12], [9, .1]]}}
springs: {tyre: {links: [b, c], stiffness: 4e4, limit: 3 kN*m}}
"""


def test_friction_and_limits_stand_in_the_tables() -> None:
    elements = _shift_elements(loads(SLIPPING))
    headings = [column.heading for column in elements.columns]
    assert headings[4:] == ["static by kinetic torque", "friction pack, SI"]
    pack = "radius: 0.1; area: 0.006; surfaces: 8; coefficient: (0, 0.12), (9, 0.1)"
    assert [row[4:] for row in elements.texts] == [["1.200", ""], ["1.000", pack]]
    springs = list(torsion_grids(loads(SLIPPING)))[1]
    assert (springs.columns[-1].heading, springs.texts[0][-1]) == ("limit, N*m", "3000")
    plain = "inertias: {a: 1, b: 2}\nshift_elements: {C: [a, b]}\n"
    assert len(_shift_elements(loads(plain)).columns) == 4


def test_efficiencies_that_depend_are_described() -> None:
    laws = {
        "0.97": "0.9700",
        "0.98 - 1.5/(T + 20)": "0.98 - 1.5/(T + 20)",
        "{over: torque, points: [[0, .9], [9, .98]]}": "2 points over torque",
        "{over: [speed, torque], columns: [0, 9], rows: [[0, .9, .9], [5, .9, .9]]}": "map over speed and torque",
    }
    head = "links: [a, b]\nload: {speed: 900 rpm, torque: 5 N*m}\nmechanisms: {pair: "
    for law, words in laws.items():
        case = loads(f"{head}{{first: a, second: b, ratio: 2, efficiency: {law}}}}}\n")
        [row] = _mechanisms(case).texts
        assert row[-1] == words
