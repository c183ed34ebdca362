"""Files of tests/bad about friction packs and limits: file, line, column, words."""

from __future__ import annotations

FAULTS = [
    ("static-below-1.yaml", 6, 13, "shift_elements.FH.static: read 0.9, expected 1 or more"),
    (
        "static-a-text.yaml",
        6,
        13,
        "shift_elements.FH.static: read 'high', expected a number or a calculation such as -96/39",
    ),
    (
        "friction-a-number.yaml",
        7,
        15,
        "shift_elements.FH.friction: read '0.12', expected a mapping with `radius`, `area`, `surfaces`, `coefficient`, `heat_capacity`, `cooling` and `ambient`",
    ),
    (
        "friction-radius-0.yaml",
        7,
        24,
        "shift_elements.FH.friction.radius: read 0, expected a radius above 0",
    ),
    (
        "friction-area-of-pressure.yaml",
        7,
        35,
        "shift_elements.FH.friction.area: read '60 kPa', expected an area in m^2, bare or with its unit; this is a pressure",
    ),
    (
        "friction-area-negative.yaml",
        7,
        35,
        "shift_elements.FH.friction.area: read -0.006, expected an area above 0",
    ),
    ("friction-area-missing.yaml", 7, 15, "shift_elements.FH.friction: `area` is missing"),
    (
        "friction-surfaces-fraction.yaml",
        7,
        54,
        "shift_elements.FH.friction.surfaces: read '8.5', expected a whole number from 1",
    ),
    (
        "friction-surfaces-0.yaml",
        7,
        54,
        "shift_elements.FH.friction.surfaces: read '0', expected a whole number from 1",
    ),
    (
        "friction-coefficient-0.yaml",
        7,
        70,
        "shift_elements.FH.friction.coefficient: read 0, expected a coefficient above 0",
    ),
    (
        "friction-coefficient-negative.yaml",
        7,
        86,
        "shift_elements.FH.friction.coefficient[2][2]: read -0.1, expected a coefficient above 0",
    ),
    (
        "friction-points-empty.yaml",
        7,
        70,
        "shift_elements.FH.friction.coefficient: read a list, expected points: [[slip, coefficient], ...]",
    ),
    (
        "friction-points-flat.yaml",
        7,
        81,
        "shift_elements.FH.friction.coefficient[2]: read '10', expected 2 numbers: [slip, coefficient]",
    ),
    (
        "friction-points-of-three.yaml",
        7,
        81,
        "shift_elements.FH.friction.coefficient[2]: read a list of 3, expected 2 numbers: [slip, coefficient]",
    ),
    (
        "friction-table-without-rows.yaml",
        7,
        70,
        "shift_elements.FH.friction.coefficient: `rows` is missing",
    ),
    (
        "friction-slip-negative.yaml",
        7,
        72,
        "shift_elements.FH.friction.coefficient[1][1]: read -1, expected a slip of 0 or more",
    ),
    (
        "friction-slips-out-of-order.yaml",
        7,
        83,
        "shift_elements.FH.friction.coefficient[2][1]: read 10, expected a slip of 20 rad/s or more: slips must ascend",
    ),
    ("spring-limit-0.yaml", 9, 58, "springs.tyre.limit: read 0, expected a torque above 0"),
    (
        "spring-limit-of-force.yaml",
        9,
        58,
        "springs.tyre.limit: read a number in N, expected N*m: its twist names no link of `masses`",
    ),
]
