"""Files of tests/bad about what moves straight, struts, limits that follow: file, line, column, words."""

from __future__ import annotations

FAULTS = [
    (
        "mass-and-inertia.yaml",
        1,
        22,
        "masses.axle: link axle is in `inertias`, too: it either rotates or moves straight",
    ),
    (
        "mass-below-0.yaml",
        1,
        10,
        "masses.body: read -5, expected a mass of 0 or more",
    ),
    (
        "straight-in-turning-unit.yaml",
        3,
        33,
        "springs.s.stiffness: read a number in N*m/rad, expected N/m: its twist names body, which is in `masses`",
    ),
    (
        "turning-in-straight-unit.yaml",
        3,
        48,
        "springs.s.damping: read a number in N*s/m, expected N*m*s/rad: its twist names no link of `masses`",
    ),
    (
        "straight-points-in-rad.yaml",
        3,
        40,
        "springs.s.points[2][1]: read a number in rad, expected m",
    ),
    (
        "damping-of-set-straight.yaml",
        4,
        63,
        "mechanisms.M.damping: read a number in N*s/m, expected N*m*s/rad: it turns",
    ),
    (
        "strut-that-turns.yaml",
        3,
        30,
        "springs.s.strut: the twist names no link of `masses`, expected at least one: a strut acts along a straight line",
    ),
    (
        "strut-half-counter-chamber.yaml",
        3,
        29,
        "springs.s.strut: expected `counter_area` and `counter_length` above 0 with `counter_pressure`",
    ),
    (
        "strut-at-its-bottom.yaml",
        3,
        98,
        "springs.s.strut.at: read -0.11, expected more than -0.11 and less than inf m",
    ),
    (
        "strut-beyond-numbers.yaml",
        3,
        29,
        "springs.s.strut: its stiffness is infinite, expected realistic dimensions",
    ),
    (
        "strut-beside-stiffness.yaml",
        3,
        33,
        "springs.s.stiffness: read `stiffness` with `strut`, expected only one of them",
    ),
    (
        "strut-without-length.yaml",
        3,
        29,
        "springs.s.strut: `length` is missing",
    ),
    (
        "limit-of-no-spring.yaml",
        4,
        61,
        "springs.tyre.limit.of: read `raer`, expected the name of a spring; did you mean `rear`?",
    ),
    (
        "limit-of-a-limit.yaml",
        4,
        61,
        "springs.tyre.limit.of: `rear` has a limit or friction of its own, expected a spring without `limit` and `friction`",
    ),
    (
        "limit-without-times.yaml",
        4,
        46,
        "springs.tyre.limit: expected both `of` and `times`, or neither",
    ),
    (
        "limit-times-0.yaml",
        4,
        74,
        "springs.tyre.limit.times: read 0, expected a number other than 0",
    ),
]
