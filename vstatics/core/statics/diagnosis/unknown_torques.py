"""Messages about torques that do not exist, are indeterminate or are uncertain."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from vstatics.core.errors import plural, spoken
from vstatics.core.model.parts import OfLoad
from vstatics.core.model.transmission import Gear
from vstatics.core.statics import digits, ideal, matrix, torques
from vstatics.core.statics.diagnosis.freedom import is_adrift, without_value
from vstatics.core.statics.diagnosis.overrunning import overrunning
from vstatics.core.statics.diagnosis.power_directions import driving_messages
from vstatics.core.statics.result_arrays import Message
from vstatics.core.statics.results import Results


def torque_messages(
    results: Results, number: int, gear: Gear, *, is_reported: bool
) -> Iterator[Message]:
    """Report torques that do not exist, are indeterminate or are uncertain.

    With `is_reported`, a message about lost digits has already reported uncertain torques.
    """
    case = results.case
    if results.tied_up[number] or results.conflict[number]:
        return  # reported as an error already
    output = case.gear_output(gear)
    if not results.balanced[number]:
        if is_adrift(results, number) and output not in gear.speeds:
            return  # already reported with the speeds
        if driving := list(driving_messages(results, number)):
            yield from driving
            return
        advice = _loaded_pumps(results, number) or _gaining_converters(results, number)
        advice = advice or _unheld_torques(results, number)
        if output in gear.speeds:
            advice = (
                f"a speed is given on the output, link {case.link_name(output)}; give the "
                "speed of the reacting link instead"
            )
        yield Message("W418", f"no torques are in equilibrium: {advice}")
    elif not (is_reported or case.has_converter) and ideal.is_uncertain(
        gear, float(results.speeds[number, output - 1]), float(results.torques[number, -1])
    ):
        yield Message(
            "W419",
            "with slightly different ratios there would be no unique solution, so rounding errors "
            "show: output torque times output speed is not 1, and only a few digits are certain; "
            "give exact ratios, for example by teeth",
        )
    elif not results.excess[number] and (  # messages about the speeds mention redundant constraints
        np.isnan(results.torques[number]).any() or np.isnan(results.mesh_torques[number]).any()
    ):
        unknown = unknown_torques(results, number)
        if unknown:
            yield Message(
                "W420",
                f"the torque of {spoken(unknown)} is indeterminate in statics",
            )


def lost_digit_messages(results: Results, number: int) -> Iterator[Message]:
    """Report speeds and torques of which rounding errors leave only a few digits."""
    lost = None if results.conflict[number] else digits.lost_digits(results.gear_at(number))
    if lost is None:
        return
    of = [f"the speed of {spoken(lost.links)}"] * bool(lost.links)
    of += [f"the torque of {spoken(lost.devices)}"] * bool(lost.devices)
    certain = f"only {lost.digits} {plural('digit', lost.digits)}" if lost.digits else "no digit"
    verb = "are" if lost.digits > 1 else "is"
    yield Message(
        "W417",
        "with slightly different ratios there would be no unique solution, so rounding errors "
        f"show: {certain} of {spoken(of)} {verb} certain; give exact ratios, for example by teeth",
    )


def _loaded_pumps(results: Results, number: int) -> str:
    """Return words for converters whose pump torque a slip determines."""
    case, gear = results.case, results.gear_at(number).gear
    first = case.own_mechanisms.start - 1
    return spoken(
        f"with this slip, the pump of {case.mechanisms[first + owner].name} takes "
        f"{torque.given:.4g} N*m, and no clutch carries the difference from the torque of "
        "the load; give another slip, or remove it"
        for owner, torque in gear.pump_torques.items()
        if isinstance(torque, OfLoad)
    )


def _gaining_converters(results: Results, number: int) -> str:
    if not results.case.has_converter:
        return ""
    state = results.gear_at(number)
    variant = state.ideal.variant
    torques_ = torques.solve_torques(results.case, state.gear, variant.columns)
    names = ideal.gaining(variant, state.ideal.direction, state.ideal.speeds, torques_)
    return f"{plural('converter', len(names))} {spoken(names)} would gain power" if names else ""


def _unheld_torques(results: Results, number: int) -> str:
    """Return words for external torques that nothing reacts, and freewheels that could."""
    case, state = results.case, results.gear_at(number)
    gear, variant = state.gear, state.ideal.variant
    input_link = case.gear_input(gear)

    def is_held(link: int, columns: Sequence[matrix.Column], more: Sequence[int] = ()) -> bool:
        alone = gear._replace(input=link, torques={}, engaged=(*gear.engaged, *more))
        return torques.solve_torques(case, alone, columns).consistent

    unheld = [link for link in (input_link, *gear.torques) if not is_held(link, variant.columns)]
    # In a geared neutral (output at rest), torques balance only with losses, whatever their size.
    factors = [0.98 - 0.01 / place for place, _ in enumerate(variant.ratios, 1)]
    lossy = [ratio * factor for ratio, factor in zip(variant.ratios, factors, strict=True)]
    if (
        results.speeds[number, case.gear_output(gear) - 1] == 0
        and not case.has_converter
        and all(is_held(link, matrix.columns(case, lossy)) for link in unheld)
    ):
        return (
            "the output is at rest and takes no power, so torques without losses have no bound; "
            "calculate ratios slightly above and below this one to see torques with losses"
        )
    links = ["the input" if link == input_link else case.link_name(link) for link in unheld]
    what = "torque of " if len(links) == 1 else "torques of "
    over = [n for n in case.freewheels if n not in gear.engaged]
    helps = any(is_held(link, variant.columns, over) for link in unheld)
    why, exchange = overrunning(case, state, over if helps else ())
    return f"nothing supports the {what}{' and of '.join(links)}{why}{exchange}"


def unknown_torques(results: Results, number: int) -> list[str]:
    """Return the devices without a determinate torque, in a gear whose torques balance."""
    if not results.calculable[number]:
        return []
    torques = results.gear_at(number).torques
    return without_value([*results.case.devices, "the output"], torques.on_first_link)
