"""A case with the teeth that were found."""

from __future__ import annotations

from dataclasses import replace

from vstatics.elements.drawing import Drawing, drawing_of
from vstatics.elements.element import Element
from vstatics.model.parts import Mechanism
from vstatics.model.transmission import Transmission
from vstatics.synthesis.teeth.layout import TeethLayout
from vstatics.synthesis.teeth.problem import TeethProblem
from vstatics.synthesis.teeth.solutions import TeethSolution


def case_with_teeth(
    case: Transmission, problem: TeethProblem, solution: TeethSolution
) -> Transmission:
    """The case with found teeth; a mechanism becomes the element that has them.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, solve
    >>> from vstatics.synthesis.teeth.finding import find_teeth
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> found = find_teeth(case, {"1": 3.6})
    >>> solve(case_with_teeth(case, found.problem, found.solutions[0])).ratio.round(9)
    array([3.6])
    """
    given = drawing_of(case)
    drawing = given or Drawing(case.links, (), case.mechanisms)
    layouts = {layout.name: layout for layout in problem.layouts}
    elements = [
        _with_teeth(one, layouts[one.name], solution) if one.name in layouts else one
        for one in drawing.elements
    ]
    left: list[Mechanism] = []
    for mechanism in drawing.mechanisms:
        layout = layouts.get(mechanism.name)
        if layout is None or layout.is_drawn:
            left.append(mechanism)
        else:
            made = replace(  # in place of the mechanism, with its links and losses
                _with_teeth(layout.element, layout, solution),
                efficiency=mechanism.efficiency,
                back_efficiency=mechanism.back_efficiency,
                stiffness=mechanism.stiffness,
                damping=mechanism.damping,
            )
            elements.append(made)
    drawn = replace(drawing, elements=tuple(elements), mechanisms=tuple(left))
    if given is None:
        return case.replace(mechanisms=(), drawing=drawn, description="", source="")
    return case.replace(drawing=drawn, description="", source="")


def _with_teeth(element: Element, layout: TeethLayout, solution: TeethSolution) -> Element:
    teeth = solution.teeth[layout.name]
    planets = solution.planets.get(layout.name, element.planets)
    if not element.rims:
        kept = {name: teeth.get(name, count) for name, count in element.teeth.items()}
        return replace(element, teeth={**kept, **teeth}, planets=planets)
    rims = {planet: {rim: teeth[rim] for rim in own} for planet, own in element.rims.items()}
    wheels = [wheel._replace(teeth=teeth[wheel.member]) for wheel in element.wheels]
    return replace(element, rims=rims, wheels=tuple(wheels), planets=planets)
