"""Everything that explains one gear, as data."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Annotated, NamedTuple

import numpy as np

from vstatics.core.arguments import refusing
from vstatics.core.errors import CaseError
from vstatics.core.explain.bodies import OwnLinks, Structure, as_solved, on_own_links, structure
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
from vstatics.core.statics.matrix import distribution_matrix, loaded_devices
from vstatics.core.statics.results import Results, expect_one_case
from vstatics.core.statics.solve import solve
from vstatics.core.statics.state import GearState
from vstatics.core.statics.status import CONFLICT, TIED_UP
from vstatics.core.tables.answer import Known, Sometimes, Words, schema
from vstatics.core.tables.html import shown


class Together(NamedTuple):
    """Links that turn as one body, whatever the ratios are."""

    links: Sequence[str]
    stands: bool
    """The housing is one of them."""
    elements: Sequence[str]
    """The engaged elements that join them, and springs that are shafts."""


class Explanation(NamedTuple):
    """A gear explained."""

    gear: str
    engaged: Sequence[str]
    """Shift elements that are engaged."""
    holding: Sequence[str]
    """Freewheels that hold."""
    not_engaged: Sequence[str]
    rows: Sequence[str]
    """Links, planets too where losses are calculated at meshes."""
    columns: Sequence[str]
    """Devices that can carry torque: engaged elements, mechanisms and springs."""
    matrix: Annotated[Floats, Words(schema(Sequence[Sequence[Known]]))]
    """(rows, columns): their structural-distribution matrix. [-]"""
    speeds: System
    torques: System | None
    """None where a gear is tied up, or its freewheels in conflict."""
    signs: Sequence[PowerSign]
    lossy: System | None
    """With losses; None where there is no such solution."""
    input_torque: Known
    """What torques are relative to: 1, or 0 where the load gives none, and they are in N*m."""
    coasts: bool
    """Power enters at the output, and the units of torque and power are negative."""
    together: Sequence[Together]
    one_piece: Sequence[str]
    """Elements, or mechanisms, that turn as one piece."""
    standing: Sequence[str]
    """Elements, or mechanisms, all of whose links stand."""
    input: str
    """The speed of the input, as the equations call it."""
    output: str
    """That of the output."""
    formula: RatioFormula | None
    reason: str
    """Why there is no formula, or nothing."""
    ratio: float
    """[-]"""
    efficiency: float
    """[-]"""
    messages: Sequence[str]
    """What was noticed in this gear."""
    balance: Sometimes[MachineBalance] = None
    """Of machines and a battery, where the gear has one."""
    tried: Sometimes[Sequence[TriedSigns]] = None
    """Signs and why none agrees, where friction locks the gear."""

    def __repr__(self) -> str:
        """Of which gear, its ratio; not all its equations."""
        told = f" = {self.formula.text}" if self.formula else ""
        return f"<Explanation {self.gear!r}: ratio {self.ratio:.4g}{told}>"

    def _repr_html_(self) -> str:
        """Its matrix, equations, solution and ratio, for a notebook."""
        return shown(higher("explanation_grids")([self]))


@refusing()
def explain_gear(results: Results, gear: int | str) -> Explanation:
    """Explain a gear: its matrix, its equations and their solution, its ratio as a formula.

    Parameters
    ----------
    results : Results
        Of one case.
    gear : int or str
        Its number from 1, or its name.

    Returns
    -------
    Explanation
        Matrix, speeds [-], torques [-], shares and the formula of the ratio, by names.

    Raises
    ------
    ValueError
        If there is no such gear, or the results are of arrays of variants.

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
    variators = {one.name: one.kind for one in results.case.mechanisms if one.kind}
    if variators:
        results = solve(_pairs(results.case, results.case.gear_number(gear) - 1))
    number = results.case.gear_number(gear) - 1
    state = results.gear_at(number)
    case, actual = as_solved(state.case), state.gear
    names = names_of(case)
    matrix = distribution_matrix(case) + 0.0
    elements = [element.name for element in case.shift_elements]
    loaded = loaded_devices(case, actual)
    torques, lossy = _torques(state, names, matrix)
    fault = FAULTS.get(state.status, "")
    own = on_own_links(case)._replace(variators=variators)
    bodies = None if fault else structure(own, actual)
    together = list(_together(own, actual, bodies)) if bodies else []
    one_piece, standing = _pieces(own, bodies) if bodies else ([], [])
    symbols = symbols_of(case, names, own)
    ratio, reason = _formula(state, names, symbols, own, bodies) if bodies else (None, fault)
    return Explanation(
        gear=actual.name,
        engaged=[elements[n - 1] for n in actual.engaged if n not in state.holding],
        holding=[elements[n - 1] for n in state.holding],
        not_engaged=[name for n, name in enumerate(elements, 1) if n not in actual.engaged],
        rows=case.link_names,
        columns=[case.devices[device] for device in loaded],
        matrix=matrix[:, loaded],
        speeds=speed_system(case, actual, names, matrix, list(map(plain, state.speeds))),
        torques=torques,
        signs=signs_of(state),
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
        messages=[
            f"{message.severity}: {message.text}"
            for message in results.messages
            if message.gear == actual.name
        ],
        balance=machine_balance(results, number),
        tried=tried_signs(state) or None,
    )


def _pairs(case: Transmission, place: int) -> Transmission:
    """The case with pairs for the variators of a gear, whose equations are those of pairs."""
    gear = case.gears[place]
    if pairs := case.as_pairs(gear):
        return pairs
    ratios = case.gear_ratios(gear)
    name, what = next(
        (one.name, "is a converter" if one.kind == "converter" else "has the speed ratio 0")
        for place, (one, ratio) in enumerate(zip(case.mechanisms, ratios, strict=True))
        if place not in case.bypassed(gear)
        and (one.kind == "converter" or (one.kind and not ratio))
    )
    raise CaseError(
        "E279",
        f"gear {gear.name}: {name} {what}, of which no equations are written yet; its sheet, "
        "`explain --worksheet`, has its rules",
    )


FAULTS = {
    CONFLICT: "the freewheels are in conflict",
    TIED_UP: f"the gear is {TIED_UP.english}",
}
"""Why a gear has no solution at all."""


def _torques(state: GearState, names: Names, matrix: Floats) -> tuple[System | None, System | None]:
    """The torque equations without losses and with them."""
    if state.status in FAULTS:
        return None, None
    ideal = torque_system(state.case, state.gear, names, matrix, state.torques, drag={})
    ratios = list(map(plain, state.lossy_ratios))
    if any(not one.has_power for one in state.statuses) or np.isnan(ratios).any():
        return ideal, None
    matrix = distribution_matrix(state.case, ratios) + 0.0
    dragging = {link: plain(torque) for link, torque in state.drag.external.items()}
    signs = signs_of(state)
    names = names.with_losses([one.sign for one in signs], [one.efficiency for one in signs])
    lossy = torque_system(state.case, state.gear, names, matrix, state.lossy_torques, drag=dragging)
    return ideal, lossy


def _formula(
    state: GearState, names: Names, symbols: Sequence[Symbol], own: OwnLinks, bodies: Structure
) -> tuple[RatioFormula | None, str]:
    """The formula, which gives what is calculated, or why there is none."""
    try:
        ratio = formula(own, state.gear, names, symbols, bodies)
    except NoFormula as none:
        return None, str(none)
    output = state.speeds[own.case.gear_output(state.gear) - 1]
    calculated = plain(state.ratio if ratio.left == "i" else output)
    if not math.isclose(ratio.value, calculated, rel_tol=SAME_FORMULA, abs_tol=ROUNDED_NUMBER):
        return None, "the mechanisms happen to have ratios at which the gear has none"
    return ratio, ""


def _together(own: OwnLinks, gear: Gear, bodies: Structure) -> Iterator[Together]:
    """Bodies of more than one link, what stands first."""
    case = own.case
    elements = [case.shift_elements[number - 1] for number in gear.engaged]
    for body in dict.fromkeys(bodies.body):
        links = [link for link, other in enumerate(bodies.body) if other == body]
        if len(links) > 1:
            names = [case.link_name(link) for link in links if link != HOUSING]
            engaged = [one.name for one in elements if bodies.body[one.first] == body]
            for spring in case.springs:
                shaft = ends(spring.twist)
                engaged += [spring.name] * (shaft is not None and bodies.body[shaft[0]] == body)
            yield Together(names, body == HOUSING, engaged)


def _pieces(own: OwnLinks, structure: Structure) -> tuple[list[str], list[str]]:
    """Names of elements, or mechanisms, that turn as one piece, and of those that stand.

    What is joined to the housing for good turns as one piece only when it stands.
    """
    one_piece, standing = [], []
    for part in own.parts:
        bodies = {structure.body[link] for one in part.lowered for link in one.mechanism.links}
        if bodies == {HOUSING}:
            standing.append(part.name)
        elif len(bodies) == 1:
            one_piece.append(part.name)
    return one_piece, standing
