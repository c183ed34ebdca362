"""Messages about redundant or contradictory constraints on the speeds, with remedies."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from vstatics.core.errors import spoken
from vstatics.core.model.parts import ShiftElement
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.numerics import elimination
from vstatics.core.statics import matrix
from vstatics.core.statics.diagnosis.freedom import matrix_rows
from vstatics.core.statics.diagnosis.unknown_torques import unknown_torques
from vstatics.core.statics.result_arrays import Message
from vstatics.core.statics.results import Results
from vstatics.core.statics.status import TIED_UP


def excess_messages(results: Results, number: int, gear: Gear) -> Iterator[Message]:
    """Report constraints on the speeds that are redundant or contradictory."""
    case, repeated, same = results.case, list[str](), list[str]()
    at_ratios = speed_ratios(results, number, gear)
    if gear.slip:
        gear = _without_converters(case, gear, at_ratios)
    rows = matrix.speed_rows(case, gear, matrix_rows(case, gear))
    names = matrix.speed_row_names(case, gear)
    always = len(matrix.always_coupled(case, gear))
    for involved, agrees in elimination.dependencies(rows):
        given_speeds = always + len(gear.carrying)
        engaged = [names[i] for i in involved if always <= i < given_speeds]
        others = [names[i] for i in involved if i >= given_speeds]
        loaded = always - sum(not spring.is_damper for spring in case.springs)
        springs = [names[i] for i in involved if loaded <= i < always]
        free = [names[i] for i in involved if i < always and names[i] in at_ratios]
        every = [names[i] for i in involved]
        conditions = spoken(engaged + springs + others if engaged or others else every)
        if not agrees:
            fixed = [name for name in free if not math.isnan(at_ratios[name])]
            sought = [name for name in free if name not in fixed]
            cure = _cure(engaged, others, fixed, sought, case.elements_at(gear.slipping))
            if free:
                conditions = spoken(
                    f"{name} at the speed ratio {at_ratios[name]:g}" if name in fixed else name
                    for name in (*engaged, *springs, *free, *others)
                )
            if not cure:
                conditions, cure = spoken(every), "check the links and ratios of these mechanisms"
            if springs:
                cure += f"; {spoken(springs)} can twist in `vstatics torsion`, but not in statics"
            yield Message(
                "E452",
                f"{TIED_UP.english}: {conditions} contradict each other, so the input cannot "
                f"turn as given; {cure}",
            )
        elif engaged:
            repeated.append(spoken(engaged) if len(engaged) > 1 else conditions)
        else:
            same.append(f"{conditions} impose the same constraint on the speeds")
    if repeated:
        count = len(repeated)
        what = "one is redundant" if count == 1 else f"{count} are redundant"
        groups = "; ".join(repeated)
        same.insert(0, f"{groups} impose the same constraint on the speeds, so {what}")
    unknown = unknown_torques(results, number)
    advice = ", release one" * bool(repeated)
    shared = f"; the torque of {spoken(unknown)} is indeterminate{advice}" if unknown else ""
    for text in same:
        yield Message("W416", text + shared)
        shared = ""  # the torques are named only in the first message


def _cure(
    engaged: Sequence[str],
    others: Sequence[str],
    fixed: Sequence[str],
    sought: Sequence[str],
    elements: Sequence[ShiftElement],
) -> str:
    """Return words for the remedies for contradictory constraints on the speeds.

    `fixed` are converters and variators with a prescribed speed ratio; for `sought`, the load
    determines it. `elements` are the slipping shift elements.
    """
    slipping = [element.name for element in elements if element.name in engaged]
    sticking = [name for name in engaged if name not in slipping]
    released = "one of the engaged shift elements" if len(engaged) > 1 else spoken(sticking)
    names = spoken(fixed)
    by_slip = f"remove the speed ratio of {names}, which the slip then determines"
    cures = [
        f"release {released}" * bool(sticking),
        f"remove the slip of {spoken(slipping)}" * bool(slipping),
        "remove a given speed" * any(name != matrix.INPUT_SPEED for name in others),
        (by_slip if slipping else f"give {names} another speed ratio") * bool(fixed),
        f"list {spoken(sought)} under `open`" * bool(sought),
    ]
    return " or ".join(filter(None, cures))


def speed_ratios(results: Results, number: int, gear: Gear) -> dict[str, float]:
    """Return the speed ratios of variators and converters [-]; NaN if the load determines them."""
    case = results.case
    calculated = results.points.gears[number] if results.points else gear
    ratios = zip(case.mechanisms, case.gear_ratios(calculated), strict=True)
    return {mechanism.name: ratio for mechanism, ratio in ratios if mechanism.kind}


def _without_converters(case: Transmission, gear: Gear, ratios: Mapping[str, float]) -> Gear:
    """Return a gear, without free converters if its other constraints contradict each other."""
    opened = with_open_converters(case, gear, ratios)
    rows = matrix.speed_rows(case, opened, matrix_rows(case, opened))
    return gear if all(agrees for _, agrees in elimination.dependencies(rows)) else opened


def with_open_converters(case: Transmission, gear: Gear, ratios: Mapping[str, float]) -> Gear:
    """Return a gear with open converters where the load determines the speed ratio."""
    first = case.own_mechanisms.start - 1
    names = [mechanism.name for mechanism in case.mechanisms]
    free = [names.index(name) - first for name, ratio in ratios.items() if math.isnan(ratio)]
    return gear._replace(open=(*gear.open, *free))
