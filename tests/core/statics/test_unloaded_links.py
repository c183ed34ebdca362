"""Links that are free on purpose, against those that a missing shift element leaves free.

The random trains are judged by exact arithmetic (`oracle`): a gear whose outputs turn, and whose
free links touch nothing that carries torque, lacks no shift element.
"""

from collections import Counter
from random import Random

from tests.chance import ranges_with_slow, seeded
from tests.oracle import gears as oracle
from tests.trains import random_ratio, random_train, shown
from vstatics import Mechanism, ShiftElement, Transmission, solve
from vstatics.core.readers import loads

OVERDRIVE = """
links: [input, sun, ring, race, output]
mechanisms: {P: {first: sun, second: ring, third: input, ratio: -2.7}}
shift_elements:
  E: [ring, input]
  D: [race, housing]
  H: {kind: freewheel, links: [sun, race]}
  O: [ring, output]
gears: {direct: [E, O]}
"""


def said(text: str) -> list[tuple[str, str]]:
    return [(message.gear or "", message.id) for message in solve(loads(text)).messages]


def test_what_hangs_behind_an_open_clutch_is_free_on_purpose() -> None:
    """An engine takes its generator along by a gear pair, which carries no torque; a take-off."""
    engine = """
links: [engine, generator, motor, output]
mechanisms: {pair: {first: engine, second: generator, ratio: -0.4}}
inertias: {engine: 0.2, generator: 0.05}
shift_elements: {C1: [engine, motor], C2: [motor, output]}
gears: {electric: {input: motor, engaged: [C2]}, engine: [C1, C2], open: {input: motor}}
"""
    assert said(engine) == [("electric", "N420"), ("open", "W414")]
    take_off = """
links: [engine, axle, stub, take-off]
output: axle
outputs: [axle, take-off]
mechanisms:
  pair: {first: stub, second: take-off, ratio: -3}
  axle: {first: engine, second: axle, ratio: -8}
shift_elements: {P: [engine, stub]}
gears: {field: [P], road: []}
"""
    assert said(take_off) == [("field", "W413"), ("road", "N420")]


def test_a_single_drag_brings_a_free_race_to_rest() -> None:
    """It takes no power then; two drags may pull the race along, so their loss is unknown.

    Without drag the race between an open brake and a freewheel is free on purpose.
    """
    [message] = solve(loads(OVERDRIVE)).messages
    told = "N420", "link race turns freely and carries no torque"
    assert (message.id, message.text) == told
    for drag in ("2 N*m", '"0.1*w"', "[[0, 0], [100, 3]]"):
        text = "load: {speed: 1000 rpm, torque: 100 N*m}\n" + OVERDRIVE
        single = text.replace("D: [race, housing]", f"D: {{links: [race, housing], drag: {drag}}}")
        assert said(single) == [("direct", "N420")]
        double = single.replace("links: [sun, race]", f"links: [sun, race], drag: {drag}")
        assert sorted(said(double)) == [("direct", "N420"), ("direct", "W412")]


def test_a_freewheel_the_wrong_way_round_is_named() -> None:
    text = """
links: [engine, input, output]
mechanisms: {pair: {first: input, second: output, ratio: -3}}
shift_elements: {F1: {kind: freewheel, links: [engine, input]}}
gears: {drive: [], coast: {coast: true}}
"""
    advice = "if the links of F1 are in the wrong order, write [input, engine]: then the gear can"
    turned = text.replace("[engine, input]}", "[input, engine]}")
    for case, advised in ((text, ["drive"]), (turned, [])):
        messages = solve(loads(case)).messages
        assert [one.gear for one in messages if advice in one.text] == advised


def with_loose_parts(rng: Random, case: Transmission) -> Transmission:
    """Return a train with further links, on open or engaged elements and on mechanisms."""
    links, elements, mechanisms = case.links, [*case.shift_elements], [*case.mechanisms]
    engaged: list[int] = []
    for _ in range(rng.randint(1, 3)):
        base = rng.randint(1, links)
        if rng.random() < 0.5:
            links += 1
            elements.append(ShiftElement(base, links, f"L{links}"))
            engaged += [len(elements)] * (rng.random() < 0.3)
        else:
            links += 2
            members = (base, links - 1, links)
            mechanisms.append(Mechanism(*members, random_ratio(rng, members), name=f"L{links}"))
    [gear] = case.gears
    left = gear.engaged[rng.random() < 0.4 :]
    gears = [gear._replace(engaged=(*left, *engaged))]
    return Transmission(links, elements, mechanisms, gears, input=case.input, output=case.output)


def is_unloaded(case: Transmission, exact: oracle.OracleGear) -> bool:
    """Whether nothing loads or drives the free links, and the output turns, by exact arithmetic."""
    free = {number for number, speed in enumerate(exact.speeds, 1) if speed is None}
    turning = {number for number, speed in enumerate(exact.speeds, 1) if speed}
    elements = [(one.first, one.second) for one in case.shift_elements]
    devices = [*elements, *(one.links for one in case.mechanisms)]
    torques = (*exact.torques.elements, *exact.torques.mechanisms)
    idle = all(
        torque == 0 and (place < len(elements) or not turning.intersection(links))
        for place, (links, torque) in enumerate(zip(devices, torques, strict=True))
        if free.intersection(links)
    )
    return idle and exact.ideal_torques_exist and case.gear_output(case.gears[0]) not in free


@ranges_with_slow(40, 600, 3000, start=1000)
def test_unloaded_links_are_those_of_exact_arithmetic(seeds: range) -> None:
    counts = Counter[str]()
    for seed in seeds:
        rng = seeded(seed)
        train = random_train(rng, regular=rng.random() < 0.8)
        case = with_loose_parts(rng, train.replace(gears=train.gears[:1]))
        [exact] = oracle.solve(case)
        found = {message.id for message in solve(case).messages} & {"W414", "N420"}
        if exact.tied_up or not exact.missing:
            expected = "W414" if exact.missing else ""
        else:
            expected = "N420" if is_unloaded(case, exact) else "W414"
        counts[expected] += 1
        assert found == ({expected} if expected else set()), (seed, shown(case))
    assert min(counts["N420"], counts["W414"]) > len(seeds) / 10
