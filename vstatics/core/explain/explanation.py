"""Explanation of a gear as data: matrix, equations, solution, formula of the ratio."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Annotated, NamedTuple

import numpy as np

from vstatics.core.arguments import refusing
from vstatics.core.elements.drawing import drawing_of
from vstatics.core.elements.group import group_of
from vstatics.core.errors import CaseError
from vstatics.core.explain.bodies import OwnLinks, Structure, as_solved, on_own_links, structure
from vstatics.core.explain.converters import ConverterPoint, converter_points, loaded_converters
from vstatics.core.explain.equations import speed_system, torque_system
from vstatics.core.explain.formula import RatioFormula, Symbol, formula, symbols_of
from vstatics.core.explain.machines import MachineBalance, machine_balance
from vstatics.core.explain.names import Names, names_of
from vstatics.core.explain.shares import NoFormula
from vstatics.core.explain.signs import PowerSign, TriedSigns, signs_of, tried_signs
from vstatics.core.explain.sums import System
from vstatics.core.extras import higher
from vstatics.core.model.springs import ends
from vstatics.core.model.transmission import HOUSING, Gear, Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.tolerances import ROUNDED_NUMBER, SAME_FORMULA
from vstatics.core.numerics.traced import plain
from vstatics.core.statics.matrix import loaded_devices, structural_matrix
from vstatics.core.statics.results import Results, expect_one_case
from vstatics.core.statics.solve import solve
from vstatics.core.statics.state import GearState
from vstatics.core.statics.status import CONFLICT, TIED_UP
from vstatics.core.tables.answer import Known, Sometimes, Words, schema
from vstatics.core.tables.html import shown


class Together(NamedTuple):
    """Links that rotate together for any ratios of the mechanisms."""

    links: Sequence[str]
    stands: bool
    """True if the links are joined to the housing, and therefore at rest."""
    elements: Sequence[str]
    """Engaged shift elements and shafts (springs) that join the links."""


class Explanation(NamedTuple):
    """Explanation of a gear: matrix, equations, solution and formula."""

    gear: str
    engaged: Sequence[str]
    """Engaged shift elements, without freewheels."""
    holding: Sequence[str]
    """Freewheels that hold."""
    not_engaged: Sequence[str]
    rows: Sequence[str]
    """Names of the links, including planets if losses are calculated at meshes."""
    columns: Sequence[str]
    """Devices that can carry torque: engaged shift elements, mechanisms and springs."""
    matrix: Annotated[Floats, Words(schema(Sequence[Sequence[Known]]))]
    """Structural-distribution matrix, (rows, columns). [-]"""
    speeds: System
    torques: System | None
    """Torque equations; None if the gear is tied up or has a freewheel conflict."""
    signs: Sequence[PowerSign]
    lossy: System | None
    """Torque equations with losses; None without a solution."""
    input_torque: Known
    """Relative input torque: 1, or 0 if the input torque is 0 (torques are then in N*m)."""
    coasts: bool
    """True if power enters at the output. The input torque and power, to which torques and powers
    are relative, then have the negative sign.
    """
    together: Sequence[Together]
    one_piece: Sequence[str]
    """Gear sets or mechanisms that rotate as a block."""
    standing: Sequence[str]
    """Gear sets or mechanisms at rest."""
    input: str
    """Symbol of the input speed, such as ``w_1``."""
    output: str
    """Symbol of the output speed."""
    formula: RatioFormula | None
    reason: str
    """Reason for a missing formula; empty if the formula exists."""
    ratio: float
    """Ratio ``w_input/w_output``. [-]"""
    efficiency: float
    """Efficiency of the gear. [-]"""
    messages: Sequence[str]
    """Messages about the gear."""
    balance: Sometimes[MachineBalance] = None
    """Battery balance of electric machines, if the gear has one."""
    tried: Sometimes[Sequence[TriedSigns]] = None
    """For a self-locking gear, combinations of power signs with their contradictions."""
    slipping: Sometimes[Sequence[str]] = None
    """Shift elements with a prescribed slip, if any."""
    converters: Sometimes[Sequence[ConverterPoint]] = None
    """Converters that carry torque, if any."""

    def __repr__(self) -> str:
        """Return a short description: gear, ratio and formula."""
        formula = f" = {self.formula.text}" if self.formula else ""
        return f"<Explanation {self.gear!r}: ratio {self.ratio:.4g}{formula}>"

    def _repr_html_(self) -> str:
        return shown(higher("explanation_grids")([self]))


@refusing()
def explain_gear(results: Results, gear: int | str) -> Explanation:
    """Explain a gear: matrix, equations, solution, and the ratio as a formula.

    Parameters
    ----------
    results : Results
        Results of a single case.
    gear : int or str
        Number of the gear from 1, or its name.

    Returns
    -------
    Explanation
        Matrix, speeds [-], torques [-], signs and the formula of the ratio, by names.

    Raises
    ------
    ValueError
        If the gear does not exist, or the results are arrays of variants.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> explained = explain_gear(solve(case), 1)
    >>> explained.ratio, explained.formula.text
    (3.5, '1 - u_D1')

    Source: Algin, Schematization and calculation of mobile machine presented as
    multibody system, figures 3 and 4.
    """
    expect_one_case(results, "explain_gear")
    asked, number = results, results.case.gear_number(gear) - 1
    points = converter_points(asked.gear_at(number), asked.case.gears[number])
    turning, results = _with_pairs(asked, number)
    number = number if results is asked else 0
    state = results.gear_at(number)
    case, actual = as_solved(turning), state.gear
    names = names_of(case)
    elements = [element.name for element in case.shift_elements]
    loaded, of_converters = loaded_devices(case, actual), loaded_converters(state)
    matrix = structural_matrix(as_solved(state.case)) + 0.0
    torques, lossy = _torques(state, names.with_torque_ratios(of_converters), matrix)
    fault = FAULTS.get(state.status, "")
    on_links = on_own_links(case)._replace(variators=_variators(asked.case))
    bodies = None if fault else structure(on_links, actual)
    together = list(_together(on_links, actual, bodies)) if bodies else []
    one_piece, standing = _pieces(on_links, bodies) if bodies else ([], [])
    symbols = symbols_of(case, names, on_links)
    ratio, reason = _formula(state, names, symbols, on_links, bodies) if bodies else (None, fault)
    return Explanation(
        gear=actual.name,
        engaged=[elements[n - 1] for n in state.engaged if n not in state.holding],
        holding=[elements[n - 1] for n in state.holding],
        not_engaged=[name for n, name in enumerate(elements, 1) if n not in actual.carrying],
        rows=case.link_names,
        columns=[case.devices[device] for device in loaded],
        matrix=matrix[:, loaded],
        speeds=_speeds(case, state, names),
        torques=torques,
        signs=[sign for n, sign in enumerate(signs_of(state)) if n not in of_converters],
        lossy=lossy,
        input_torque=case.input_torque(actual),
        coasts=case.coasts(actual),
        together=together,
        one_piece=one_piece,
        standing=standing,
        input=names.speeds[case.gear_input(actual)],
        output=names.speeds[case.gear_output(actual)],
        formula=ratio,
        reason=reason,
        ratio=float(results.ratio[number]),
        efficiency=float(results.efficiency[number]),
        messages=[*_messages_about(asked, actual.name), *_assumed_teeth(results, case)],
        balance=machine_balance(results, number),
        tried=tried_signs(state) or None,
        slipping=[elements[n - 1] for n in actual.slipping] or None,
        converters=points or None,
    )


def _messages_about(results: Results, gear: str) -> Iterator[str]:
    for message in results.messages:
        if message.gear == gear:
            yield f"{message.severity}: {message.text}"


def _assumed_teeth(results: Results, case: Transmission) -> Iterator[str]:
    """Yield a note on each planet that is a link and whose teeth are assumed."""
    drawing = drawing_of(results.case)
    elements = drawing.elements if drawing else ()
    for element in elements:
        names = {f"{element.name}.{planet}" for planet in element.planet_names}
        if names.isdisjoint(case.link_names):
            continue
        for planet, rims in group_of(element).planets.items():
            if None in rims.values() and (name := f"{element.name}.{planet}") in case.link_names:
                yield (
                    f"note: the teeth of planet {name} are not given; its speed and torques hold "
                    "for one tooth"
                )


def _variators(case: Transmission) -> list[str]:
    return [mechanism.name for mechanism in case.mechanisms if mechanism.kind]


def _with_pairs(results: Results, number: int) -> tuple[Transmission, Results]:
    """Return the case with gear pairs instead of variators and converters, and the results.

    A gear pair has the speed equation of a converter, but not the torque ratio. The results are
    therefore calculated with the converters. A case without variators and converters is returned
    unchanged.
    """
    state, given = results.gear_at(number), results.case.gears[number]
    case, unloaded = state.case, state.case.unloaded_converters(given)
    if not _variators(case):
        return case, results
    mechanisms, converters = list(case.mechanisms), {}
    for place, mechanism in enumerate(case.mechanisms):
        if not mechanism.kind or place in unloaded:
            continue
        ratio = plain(state.ideal.variant.ratios[place])
        if not ratio or math.isnan(ratio):
            what = "the speed ratio 0" if ratio == 0 else "no known speed ratio"
            raise CaseError(
                "E279",
                f"gear {given.name}: {mechanism.name} has {what}, so its equations cannot be "
                "written; for its exercise sheet use `explain --worksheet`",
            )
        if mechanism.kind == "converter":
            converters[place] = mechanism._replace(ratio=ratio)
            mechanisms[place] = mechanism._replace(kind="variator", ratio=ratio, points=())
    gear = given._replace(pump_torques=state.gear.pump_torques)
    pairs = replace(case, mechanisms=mechanisms, gears=[gear]).as_pairs(gear)
    assert pairs is not None  # noqa: S101 - every speed ratio is known, and not 0
    loaded = [converters.get(place, pair) for place, pair in enumerate(pairs.mechanisms)]
    return pairs, solve(replace(pairs, mechanisms=loaded))


FAULTS = {
    CONFLICT: "the freewheels are in conflict",
    TIED_UP: f"the gear is {TIED_UP.english}",
}
"""Reason for the missing solution, by status."""


def _speeds(case: Transmission, state: GearState, names: Names) -> System:
    matrix, speeds = structural_matrix(case) + 0.0, list(map(plain, state.speeds))
    return speed_system(case, state.gear, names, matrix, speeds)


def _torques(state: GearState, names: Names, matrix: Floats) -> tuple[System | None, System | None]:
    if state.status in FAULTS:
        return None, None
    ideal = torque_system(state.case, state.gear, names, matrix, state.torques, drag={})
    ratios = list(map(plain, state.lossy_ratios))
    if any(not status.has_power for status in state.statuses) or np.isnan(ratios).any():
        return ideal, None
    matrix = structural_matrix(state.case, ratios) + 0.0
    dragging = {link: plain(torque) for link, torque in state.drag.external.items()}
    signs = signs_of(state)
    names = names.with_losses(
        [status.sign for status in signs], [status.efficiency for status in signs]
    )
    lossy = torque_system(state.case, state.gear, names, matrix, state.lossy_torques, drag=dragging)
    return ideal, lossy


def _formula(
    state: GearState, names: Names, symbols: Sequence[Symbol], on_links: OwnLinks, bodies: Structure
) -> tuple[RatioFormula | None, str]:
    """Return the formula if its value is the calculated ratio, else why it is missing."""
    try:
        ratio = formula(on_links, state.gear, names, symbols, bodies)
    except NoFormula as none:
        return None, str(none)
    output = state.speeds[on_links.case.gear_output(state.gear) - 1]
    calculated = plain(state.ratio if ratio.left == "i" else output)
    if not math.isclose(ratio.value, calculated, rel_tol=SAME_FORMULA, abs_tol=ROUNDED_NUMBER):
        return None, "the mechanisms happen to have ratios at which the gear has no ratio"
    return ratio, ""


def _together(on_links: OwnLinks, gear: Gear, bodies: Structure) -> Iterator[Together]:
    """Yield groups of two or more links that rotate together, links at rest first."""
    case = on_links.case
    elements = case.elements_at(gear.joining)
    for body in dict.fromkeys(bodies.body):
        links = [link for link, other in enumerate(bodies.body) if other == body]
        if len(links) > 1:
            names = [case.link_name(link) for link in links if link != HOUSING]
            engaged = [element.name for element in elements if bodies.body[element.first] == body]
            for spring in case.springs:
                shaft = ends(spring.twist)
                engaged += [spring.name] * (shaft is not None and bodies.body[shaft[0]] == body)
            yield Together(names, body == HOUSING, engaged)


def _pieces(on_links: OwnLinks, structure: Structure) -> tuple[list[str], list[str]]:
    """Return the names of gear sets and mechanisms that rotate as a block, or are at rest.

    A mechanism that has the housing as a link can only be at rest.
    """
    one_piece, standing = [], []
    for part in on_links.parts:
        bodies = {
            structure.body[link] for lowered in part.lowered for link in lowered.mechanism.links
        }
        if bodies == {HOUSING}:
            standing.append(part.name)
        elif len(bodies) == 1:
            one_piece.append(part.name)
    return one_piece, standing
