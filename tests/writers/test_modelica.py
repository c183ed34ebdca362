"""Cases as Modelica: what is written, and that its equations are those of statics."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from tests.commands import CASES, MZKT, vstatics
from tests.writers.modelica_system import IDENTIFIER, parsed, solved
from vstatics import Gear, Load, Mechanism, ShiftElement, Spring, Transmission, load, loads, solve
from vstatics.model.parts import Damping, Friction
from vstatics.writers import modelica, modelica_limits
from vstatics.writers.modelica_models import Identifiers, class_name, identifier, string


@pytest.mark.parametrize(
    "file",
    [
        "tarasik-box.yaml",  # sets of four degrees of freedom
        "zf-8hp70.yaml",  # drawn
        "ravigneaux-gf4a.yaml",  # planets that are shared
        "simpson-th400.yaml",  # a freewheel
        "umdm-reduced.yaml",  # a set of two planets in a row
        "driveline-8hp70.yaml",  # springs and gear pairs
        "mzkt7922.yaml",
    ],
)
def test_the_equations_are_those_of_statics(file: str) -> None:
    """The text is read here by itself, and its equations are solved all together."""
    results = solve(load(CASES / file))
    case = results.case
    written = parsed(modelica.write(case))
    elements = [one.name for one in case.shift_elements]
    for index, gear in enumerate(case.gears):
        first, last = case.gear_input(gear), case.gear_output(gear)
        ends = written.links[first - 1], written.links[last - 1]
        holding = {identifier(elements[n]) for n in np.flatnonzero(results.holds[index])}
        found = solved(written, holding, ends)
        own = written.links[: case.own_links]
        speeds = [found[f"w {link}"] for link in own]
        assert speeds == pytest.approx(results.speeds[index].tolist(), abs=1e-9)
        output = results["torques", "Mx", index + 1]
        assert -found[f"tau {ends[1]}"] == pytest.approx(output, abs=1e-9)
        for number, (name, one) in enumerate(zip(elements, case.shift_elements, strict=True)):
            flange = "flange_b" if one.is_freewheel and one.first else "flange_a"
            torque = found[f"tau {identifier(name)}.{flange}"]
            sign = -1 if one.first == 0 else 1
            expected = sign * results.torques[index, number]
            assert torque == pytest.approx(expected, abs=1e-9), name


def test_every_part_has_its_line() -> None:
    text = modelica.write(
        Transmission(
            4,
            [
                ShiftElement(1, 2, "C", capacity=2, static=1.2),
                ShiftElement(0, 3, "B"),
                ShiftElement(3, 0, "F", "freewheel"),
                ShiftElement(1, 3, "P", friction=Friction(0.1, 60e-4, 8, ((0, 0.12), (10, 0.1)))),
                ShiftElement(2, 4, "Q", friction=Friction(0.1, 60e-4, 8, ((5, 0.12),))),
            ],
            [
                Mechanism(1, 2, 3, -2.5, name="plain"),
                Mechanism(1, 2, 3, -0.4, name="turned"),
                Mechanism(1, 2, 3, 1.6, name="two planets"),
                Mechanism(3, 4, 0, -2.0, name="pair"),
                Mechanism(3, 4, 0, 2.0, name="soft", stiffness=9e4, damping=12),
            ],
            [Gear([1])],
            inertias={1: 0.5, 2: 0},
            springs=[
                Spring({4: 1}, stiffness=5e3, name="mount"),
                Spring({1: 1, 4: -1}, compliance=0.5, damping=3, name="shaft"),
                Spring({1: 1, 2: -4.2, 3: 3.2}, stiffness=9e3, name="axle"),
            ],
            load=Load(torque=-300),
        )
    )
    rotational = "Modelica.Mechanics.Rotational."
    for line in (
        f"{rotational}Interfaces.Flange_a '1' \"link 1\";",
        f'{rotational}Components.Inertia J_1(J = 0.5) "of 1";',
        f'{rotational}Components.IdealPlanetary plain(ratio = 2.5) "plain";',
        f'{rotational}Components.IdealPlanetary turned(ratio = 2.5) "turned";',
        "connect(turned.ring, '1');",
        "ThreeLink 'two planets'(u = 1.6) \"two planets\";",
        f'{rotational}Components.IdealGear pair(ratio = -2.0) "pair";',
        'ElasticLinks2 soft(k1 = 1.0, k2 = -2.0, c = 90000.0, d = 12.0) "soft";',
        f'{rotational}Components.SpringDamper mount(c = 5000.0, d = 0.0) "mount";',
        "connect(mount.flange_b, housing.flange);",
        f'{rotational}Components.SpringDamper shaft(c = 2.0, d = 3.0) "shaft";',
        'ElasticLinks3 axle(k1 = 1.0, k2 = -4.2, k3 = 3.2, c = 9000.0, d = 0.0) "axle";',
        "connect(axle.flange3, '3');",
        f'{rotational}Components.Clutch C(fn_max = 600.0, cgeo = 1, mu_pos = [0, 1], peak = 1.2) "C";',
        "C.f_normalized = control_C/600.0;",
        f'{rotational}Components.Brake B(fn_max = 1.0, cgeo = 1, mu_pos = [0, 1], peak = 1.0) "B";',
        "connect(B.flange_a, '3');",
        f'{rotational}Components.OneWayClutch F(fn_max = 1) "F";',
        "connect(F.flange_b, '3');",
        "F.f_normalized = 0;",
        f"{rotational}Components.Clutch P(fn_max = 600.0, cgeo = 0.8, "
        'mu_pos = [0.0, 0.12; 10, 0.1; 11, 0.1], peak = 1.0) "P";'.replace("10,", "10.0,").replace("11,", "11.0,"),
        "P.f_normalized = control_P/100000.0;",
        f"{rotational}Components.Fixed housing;",
        'Modelica.Blocks.Interfaces.RealInput control_P(unit = "Pa") "Pressure of P, [Pa]";',
    ):  # fmt: skip
        assert f"    {line}\n" in text
    assert "mu_pos = [0.0, 0.12; 5.0, 0.12; 6.0, 0.12]" in text
    assert "J_2" not in text
    assert re.findall(r"^  model (\w+)", text, re.MULTILINE) == [
        "ElasticLinks2",
        "ElasticLinks3",
        "ThreeLink",
        "Gearbox",
    ]


def test_planets_with_a_mass_are_told_by_their_links() -> None:
    case = loads("""
links: [sun, ring, carrier]
elements:
  P: {kind: planetary, sun: sun, ring: ring, carrier: carrier, teeth: {sun: 30, ring: 75},
      planets: 4, planet: {inertia: 1e-4, mass: 0.5, radius: 0.25}}
shift_elements: {B: [ring, housing]}
gears: {low: [B]}
""")
    text = modelica.write(case)
    speed = "k1 = -1.3333333333333333, k2 = 2.3333333333333335, J = 0.0004"
    assert f"SharedInertia2 'J_P.planet'({speed}) \"P.planet\";" in text
    assert "SharedInertia1 'J_P.planet_2'(k1 = 1.0, J = 0.125)" in text


def test_what_is_left_out_is_listed() -> None:
    case = Transmission(
        3,
        [
            ShiftElement(1, 2, "C", "dog_clutch", stiffness=9e4),
            ShiftElement(3, 0, "B", drag=0.1, capacity=2),
        ],
        [Mechanism(1, 2, 3, -2.5, 0.97, name="P"), Mechanism(1, 2, 0, 2.0, name="G")],
        [Gear([1], name="low"), Gear(speeds={2: 1}, name="run"), Gear(input=2, drag={1: 1})],
        springs=[
            Spring({1: 1}, stiffness=9, limit=3, damping=Damping(0, 0.1), name="S"),
            Spring({2: 1}, points=[(0, 0), (1, 5)], friction=2, name="Z"),
        ],
        coast=True,
        load=Load(speed=100),
    )
    assert modelica_limits.lost(case) == [
        "the losses of P",
        "the drag of B",
        "the stiffness of C",
        "the capacity, by a torque that no load tells, of B",
        "the jump of speeds of C",
        "the limit of S",
        "the points of Z",
        "the friction of Z",
        "the loss factor of S",
        "drag in gear 3",
        "given speeds and torques in gear run",
        "the input or output of its own of gear 3",
        "the load",
        "that power enters at the output",
    ]


def test_the_suffix_tells_the_format(tmp_path: Path) -> None:
    file = tmp_path / "box.mo"
    said = vstatics("convert", CASES / "tarasik-set.yaml", file)
    assert (said.status, said.all) == (0, "")
    text = file.read_text(encoding="utf-8")
    assert text.startswith('package Two_speed_planetary_set "Two-speed planetary set"\n')
    assert text.endswith("end Two_speed_planetary_set;\n")
    said = vstatics("convert", CASES / "tarasik-set.yaml", "-", "--to", "modelica")
    assert said.out == text


def test_what_is_lost_is_told(tmp_path: Path) -> None:
    said = vstatics("convert", MZKT, tmp_path / "box.mo")
    assert said.status == 1
    assert said.err.endswith("box.mo: not kept: the losses of D1, D2, D3\n")
    said = vstatics("check", tmp_path / "box.mo")
    assert said.status == 1  # it is not read


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("F1", "F1"),
        ("_", "_"),
        ("in", "'in'"),
        ("time", "'time'"),
        ("1", "'1'"),
        ("6R", "'6R'"),
        ("low gear", "'low gear'"),
        ("P1.planet", "'P1.planet'"),
        ("a'b\"c\\d", "'a_b_c_d'"),
        ("Вал", "'___'"),
        ("", "''"),
    ],
)
def test_names_are_identifiers(name: str, expected: str) -> None:
    assert identifier(name) == expected


def test_names_are_given_once() -> None:
    names = Identifiers(["housing"])
    assert [names.new(name) for name in ("Вал", "Дно", "a", "a", "housing", "a_2")] == [
        "'___'",
        "'____2'",
        "a",
        "a_2",
        "housing_2",
        "a_2_2",
    ]
    assert [class_name(name) for name in ("Коробка", "end", "8-HP", "a b")] == [
        "Case",
        "Case_end",
        "Case_8_HP",
        "a_b",
    ]


HOSTILE = '"); end Gearbox; //\\ \x1b[31m <b>&'
"""Nothing of it may act."""


def test_texts_of_a_case_do_nothing() -> None:
    names = ["');", '"', "\\", "connect(a, b)"]
    case = Transmission(
        4,
        [ShiftElement(1, 2, "equation")],
        [Mechanism(2, 3, 4, -2.5, name="model Gearbox")],
        [Gear([1], name="</table>")],
        name="end; \" '",
        description=HOSTILE,
        source=HOSTILE,
        link_names=names,
        inertias={1: 1},
    )
    text = modelica.write(case)
    assert "\x1b" not in text
    assert "<b>" not in text
    assert "<td>&lt;/table&gt;</td>" in text
    without = re.sub(r'"(\\.|[^"\\])*"', '""', text)
    for line in without.splitlines():
        code = re.sub(IDENTIFIER.replace(r"|\w+", ""), "x", line)
        assert not set(code) & set("\\\"'<>&") - {'"'}, line
    assert len(re.findall(r"^  end Gearbox;$", without, re.MULTILINE)) == 1


def test_a_string_is_one() -> None:
    assert string('a\\"b"\n') == '"a\\\\\\"b\\"\n"'


def test_a_part_is_not_called_like_a_model_of_the_file() -> None:
    names = ["ThreeLink", "Gearbox", "SharedInertia2", "housing's"]
    case = Transmission(
        4,
        [ShiftElement(4)],
        [Mechanism(1, 2, 3, 1.6, name="ElasticLinks3"), Mechanism(3, 4, 0, 2, name="end")],
        [Gear([1])],
        link_names=names,
    )
    assert parsed(modelica.write(case)).links == [
        "ThreeLink_2",
        "Gearbox_2",
        "SharedInertia2_2",
        "'housing_s'",
    ]
    assert "ThreeLink ElasticLinks3_2(u = 1.6)" in modelica.write(case)
