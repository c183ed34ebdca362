"""Small trains at which a solver is most easily wrong; most were found in random runs."""

from vstatics.core.model.transmission import Gear, Mechanism, ShiftElement, Transmission

D, S, T = Mechanism, ShiftElement, Transmission

NASTY: dict[str, Transmission] = {
    "turned": T(
        4,
        [S(1, 3)],
        [D(3, 2, 0, 0.33, 0.923), D(4, 3, 2, 0.72, 0.91), D(2, 3, 1, -2.145, 0.93)],
        [Gear()],
    ),
    "turned, idle convention crosses u = 1": T(
        4,
        [S(3)],
        [D(4, 1, 0, 1.0, 0.964), D(4, 3, 1, 1.01, 0.84), D(2, 0, 3, -1.476)],
        [Gear(input=3, output=4)],
        idle="published",
    ),
    "ideal signs admissible, another set better": T(
        3, [S(2, 3)], [D(1, 2, 0, 1.002, 0.71), D(1, 2, 3, 1.01, 0.75)], [Gear()]
    ),
    "several, ideal signs not admissible": T(
        7,
        [S(4), S(6, 7)],
        [
            D(3, 4, 2, 0.69, 0.97),
            D(7, 1, 2, 1.25, 0.61),
            D(3, 1, 5, 0.83, 0.74),
            D(3, 5, 6, -0.77, 0.96),
        ],
        [Gear([1, 2])],
    ),
    "several, given loads": T(
        4,
        [S(1, 3)],
        [D(0, 4, 3, 2.0, 0.89), D(4, 3, 1, 1.54, 0.57), D(2, 1, 3, -2.745, 0.83)],
        [Gear(torques={3: -1.21, 1: -0.46})],
        idle="published",
    ),
    "locked, drive": T(
        3,
        [S(1)],
        [D(0, 3, 1, -2.077, 0.84), D(2, 3, 1, -1.8, 0.952)],
        [Gear(input=2, output=3)],
        output=2,
    ),
    "locked, coasting": T(
        3, [S(1)], [D(1, 2, 3, 1.004, 0.98)], [Gear([1], input=3, output=2)], coast=True
    ),
    "locked, lossy output torque is 0": T(
        3, [S(1)], [D(1, 2, 3, 1.25, 0.8)], [Gear([1], input=2, output=3)]
    ),
    "locked, lossy system singular": T(
        3, [S(1)], [D(1, 2, 3, 1.25, 0.8)], [Gear([1], input=3, output=2)], coast=True
    ),
    "locked with a missing condition": T(
        4, [S(4)], [D(1, 3, 2, 1.45, 0.88), D(0, 1, 4, 0.99, 0.978)], [Gear()]
    ),
    "idle by coincidence, efficiency depends on it": T(
        3, [S(2)], [D(2, 3, 0, 1.0, 0.855), D(1, 2, 3, -3.7, 0.98)], [Gear(input=3, output=1)]
    ),
    "no ideal torque, sign of the lossy flow": T(
        6,
        [S(3), S(1)],
        [
            D(6, 1, 5, -2.6, 0.95),
            D(0, 3, 6, 1.0, 0.95),
            D(3, 6, 1, -0.4, 0.97, 0.53),
            D(1, 3, 2, -1.0, 0.953, 1.46),
            D(3, 6, 4, 1.5, 0.81),
        ],
        [Gear(input=2, output=1)],
        coast=True,
    ),
    "redundant with relative motion": T(
        4,
        [S(3, 2), S(4, 2)],
        [D(1, 3, 0, -2.0, 0.98), D(1, 4, 0, -2.0, 0.97)],
        [Gear([1, 2])],
        output=2,
    ),
    "redundant, lossy mechanism in a closed loop at one speed": T(
        3, [S(1, 3)], [D(2, 3, 0, 1.0, 0.969), D(1, 2, 3, 0.28, 0.854)], [Gear([1])]
    ),
    "one piece, split of torque open": T(
        3, [S(1, 3)], [D(2, 3, 1, 0.43, 0.998), D(2, 3, 1, -3.96, 0.98)], [Gear([1])]
    ),
    "free set, but the ratio stands": T(
        4, [S(1, 4)], [D(2, 4, 3, -2.0, 0.95), D(0, 4, 1, -3.5, 0.97)], [Gear()]
    ),
    "ratio 1 holds first, leaves third loose, output stands still": T(
        3, [S(3)], [D(3, 2, 0, 1.0), D(2, 0, 1, 1.0, 0.98)], [Gear()]
    ),
    "tied up, torques would exist": T(
        3, [S(3)], [D(1, 3, 2, -0.82, 0.972), D(3, 1, 2, 1.25, 0.967)], [Gear([1])]
    ),
    "right count, input held and output free": T(
        4, [S(1), S(4)], [D(1, 2, 3, -2.0, 0.97), D(2, 3, 4, -1.5, 0.97)], [Gear([1])]
    ),
    "a held link without ideal torque, efficiency above 1": T(
        4,
        [S(1, 3)],
        [D(2, 1, 4, -1.0, 0.853), D(0, 2, 3, -3.9, 0.951)],
        [Gear(speeds={3: 1.0}, torques={2: 1.0})],
        idle="published",
    ),
    "sides change, efficiency above 1 is the largest": T(
        5,
        [S(3), S(1, 2)],
        [D(5, 3, 1, 0.95, 0.8), D(4, 2, 5, -0.3, 0.92)],
        [Gear([2], speeds={4: 1.06}, torques={5: 1.88, 2: -0.75})],
        output=3,
        idle="published",
        coast=True,
    ),
    "no power at all": T(3, [S(2)], [D(1, 2, 3, -2.0, 0.97)], [Gear([1], torques={1: -1.0})]),
    "input gives power back": T(
        3, [S(2)], [D(1, 2, 3, -2.0, 0.97)], [Gear([1], torques={1: -3.0})]
    ),
    "speed of the output given": T(3, [S(2)], [D(1, 2, 3, -2.0, 0.97)], [Gear(speeds={3: 0.25})]),
    "output speed that it has anyway": T(
        3, [S(2)], [D(1, 2, 3, -1.0, 0.97)], [Gear([1], speeds={3: 0.5})]
    ),
}
