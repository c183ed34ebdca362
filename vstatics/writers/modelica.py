"""A case as a model of Modelica, on its standard library."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from html import escape
from typing import NamedTuple

from vstatics.elements.drawing import drawing_of
from vstatics.elements.planet_inertia import PlanetInertia, planet_inertias
from vstatics.errors import CaseError
from vstatics.model.parts import HOUSING, Mechanism, OfLoad, ShiftElement, damping
from vstatics.model.springs import Spring, ends
from vstatics.model.transmission import Transmission
from vstatics.writers.modelica_models import (
    LIBRARY,
    THREE_LINK,
    Identifiers,
    class_name,
    own_model,
    own_names,
    string,
)

MODEL = "Gearbox"
"""The model within the package."""
HOUSE = "housing"
TWO_FLANGES = ("flange_a", "flange_b")
FULL_PRESSURE = 1e5
"""Pa, at which the normal force of a friction pack is `fn_max`."""


def write(case: Transmission) -> str:
    """A package with the model ``Gearbox``: links are its flanges, controls its inputs.

    A control is the capacity of a shift element [N*m], or the pressure where the element has
    a friction pack [Pa]. See `modelica_limits.lost` for what the model does not have.

    Examples
    --------
    >>> from vstatics.model.transmission import Gear
    >>> case = Transmission(2, [], [Mechanism(1, 2, 0, -2.5, name="pair")], [Gear()])
    >>> print(write(case).partition("equation")[2].splitlines()[1].strip())
    connect(pair.flange_a, '1');
    """
    if kinds := [one.name for one in case.mechanisms if one.kind]:
        message = f"{kinds[0]} has a speed ratio, which no model in Modelica holds yet"
        raise CaseError("E278", message)
    gearbox = _Gearbox(case)
    gearbox.fill()
    package = class_name(case.name)
    own = (own_model(name, links) for name, links in sorted(gearbox.used))
    info = "\n".join(["<html>", *_told(case), "</html>"])
    return "".join(
        [
            f"package {package} {string(case.name or 'A transmission')}\n",
            *own,
            f"  model {MODEL} {string(f'Links are flanges, controls inputs: {case.name}')}\n",
            *(f"    {line}\n" for line in gearbox.declarations),
            "  equation\n",
            *(f"    {line}\n" for line in gearbox.equations),
            f"    annotation(Documentation(info = {string(info)}));\n",
            f"  end {MODEL};\n",
            '  annotation(uses(Modelica(version = "4.0.0")));\n',
            f"end {package};\n",
        ]
    )


class _Control(NamedTuple):
    """How an input becomes the normal force of a friction element."""

    unit: str
    meaning: str
    largest: float
    """Of the input where the normal force is `fn_max`."""
    parameters: str


class _Gearbox:
    """The declarations and equations of the model, gathered part by part."""

    def __init__(self, case: Transmission) -> None:
        self.case = case
        self.names = Identifiers([HOUSE, MODEL, *own_names(case.links)])
        self.links = [HOUSE, *map(self.names.new, case.link_names)]
        self.used: set[tuple[str, int]] = set()
        """Models of our own, with the number of their links."""
        self.declarations: list[str] = []
        self.equations: list[str] = []

    def fill(self) -> None:
        """All parts: links, inertias, mechanisms, shift elements, springs, the housing."""
        case = self.case
        for name, link in zip(self.links[1:], case.link_names, strict=True):
            self.declare("Interfaces.Flange_a", name, "", f"link {link}")
        for number, inertia in case.inertias.items():
            if inertia:
                link = case.link_names[number - 1]
                name = self.names.new(f"J_{link}")
                self.declare("Components.Inertia", name, f"J = {inertia!r}", f"of {link}")
                self.join(f"{name}.flange_a", number)
        drawing = drawing_of(case)
        for motion in planet_inertias(drawing) if drawing else ():
            self.planet(motion)
        for mechanism in case.mechanisms:
            self.mechanism(mechanism)
        for element in case.shift_elements:
            self.element(element)
        for spring in case.springs:
            self.spring(spring)
        if any(f"{HOUSE}.flange" in line for line in self.equations):
            self.declare("Components.Fixed", HOUSE, "", "")

    def declare(self, kind: str, name: str, parameters: str, comment: str) -> None:
        """A component of the standard library, or of a model of our own."""
        kind = f"{LIBRARY}.{kind}" if "." in kind else kind
        given = f"({parameters})" if parameters else ""
        self.declarations.append(f"{kind} {name}{given}{f' {string(comment)}' * bool(comment)};")

    def join(self, flange: str, link: int) -> None:
        """A flange of a component on a link, or on the housing."""
        to = f"{HOUSE}.flange" if link == HOUSING else self.links[link]
        self.equations.append(f"connect({flange}, {to});")

    def join_all(self, name: str, flanges: Sequence[str], links: Sequence[int]) -> None:
        """The flanges of a component on links, as far as there are any."""
        for flange, link in zip(flanges, links, strict=False):
            self.join(f"{name}.{flange}", link)

    def planet(self, motion: PlanetInertia) -> None:
        name = self.names.new(f"J_{motion.name}")
        self.shared("SharedInertia", name, motion.speed, f"J = {motion.inertia!r}", motion.name)

    def shared(
        self, kind: str, name: str, form: Mapping[int, float], parameters: str, comment: str
    ) -> None:
        """A component whose flanges are those of a sum over links."""
        self.used.add((kind, len(form)))
        parts = (f"k{place} = {float(part)!r}" for place, part in enumerate(form.values(), 1))
        self.declare(f"{kind}{len(form)}", name, f"{', '.join(parts)}, {parameters}", comment)
        for place, link in enumerate(form, 1):
            self.join(f"{name}.flange{place}", link)

    def mechanism(self, one: Mechanism) -> None:
        """A pair, a plain set, or another device of three links; with a stiffness, a twist."""
        name, ratio = self.names.new(one.name), one.ratio
        flanges: Sequence[str] = ("first", "second", "third")
        if one.stiffness is not None:
            parts = zip(one.links, (1.0, -ratio, ratio - 1), strict=True)
            form = {link: part for link, part in parts if link != HOUSING and part}
            self.shared("ElasticLinks", name, form, _elastic(one, one.stiffness), one.name)
            return
        if one.third == HOUSING:
            flanges = TWO_FLANGES
            self.declare("Components.IdealGear", name, f"ratio = {ratio!r}", one.name)
        elif ratio < 0 and max(one.links) <= self.case.own_links:
            flanges = ("sun", "ring", "carrier") if ratio <= -1 else ("ring", "sun", "carrier")
            teeth = -ratio if ratio <= -1 else -1 / ratio
            self.declare("Components.IdealPlanetary", name, f"ratio = {teeth!r}", one.name)
        else:
            self.used.add((THREE_LINK, 3))
            self.declare(THREE_LINK, name, f"u = {ratio!r}", one.name)
        self.join_all(name, flanges, one.links)

    def element(self, one: ShiftElement) -> None:
        """A clutch or brake with its control; a freewheel has none."""
        name = self.names.new(one.name)
        if one.is_freewheel:  # its flange_b may turn forward against its flange_a
            self.declare("Components.OneWayClutch", name, "fn_max = 1", one.name)
            self.join_all(name, TWO_FLANGES, one.links[::-1])
            self.equations.append(f"{name}.f_normalized = 0;")
            return
        control, known = self.names.new(f"control_{one.name}"), _control(self.case, one)
        meaning = f"{known.meaning} of {one.name}, [{known.unit}]"
        given = f'(unit = "{known.unit}")'
        real = "Modelica.Blocks.Interfaces.RealInput"
        self.declarations.append(f"{real} {control}{given} {string(meaning)};")
        turning = [link for link in one.links if link != HOUSING]
        kind = "Clutch" if turning[1:] else "Brake"
        self.declare(f"Components.{kind}", name, known.parameters, one.name)
        self.join_all(name, TWO_FLANGES, turning)
        self.equations.append(f"{name}.f_normalized = {control}/{known.largest!r};")

    def spring(self, one: Spring) -> None:
        name, shaft = self.names.new(one.name), ends(one.twist)
        if shaft is None:
            self.shared("ElasticLinks", name, one.form, _elastic(one, one.rate), one.name)
            return
        self.declare("Components.SpringDamper", name, _elastic(one, one.rate), one.name)
        self.join_all(name, TWO_FLANGES, shaft)


def _elastic(one: Spring | Mechanism, stiffness: float) -> str:
    return f"c = {stiffness!r}, d = {damping(one.damping).viscous!r}"


def _control(case: Transmission, one: ShiftElement) -> _Control:
    """With a coefficient of 1 and a force of 1 N for each N*m, unless there is a friction pack."""
    peak = f", peak = {one.static!r}"
    if one.pack is None:
        largest = _capacity(case, one)
        parameters = f"fn_max = {largest!r}, cgeo = 1, mu_pos = [0, 1]{peak}"
        return _Control("N.m", "Capacity", largest, parameters)
    radius, area, surfaces, points = *one.pack[:3], one.pack.points
    points = ((0.0, points[0][1]), *(point for point in points if point[0] > 0))
    if len(points) > 1:  # the library goes on straight behind the last
        points = (*points, (points[-1][0] + 1, points[-1][1]))
    table = "; ".join(f"{slip!r}, {coefficient!r}" for slip, coefficient in points)
    return _Control(
        "Pa",
        "Pressure",
        FULL_PRESSURE,
        f"fn_max = {area * FULL_PRESSURE!r}, cgeo = {radius * surfaces!r}, "
        f"mu_pos = [{table}]{peak}",
    )


def _capacity(case: Transmission, one: ShiftElement) -> float:
    """In N*m; 1 where it is not known."""
    if isinstance(one.capacity, OfLoad):
        return one.capacity.given
    torque = case.load.torque if case.load else None
    return one.capacity * abs(torque) if one.capacity is not None and torque else 1.0


def _told(case: Transmission) -> Iterator[str]:
    """What the case says of itself, and what its gears engage, in HTML."""
    for text in (case.description, case.source):
        if text:
            yield f"<p>{escape(text.strip())}</p>"
    ends_of = [case.link_name(link) for link in (case.input, case.output)]
    yield f"<p>Input: {escape(ends_of[0])}, output: {escape(ends_of[1])}.</p>"
    yield "<table>"
    yield "<tr><th>gear</th><th>engaged</th></tr>"
    for gear in case.gears:
        engaged = ", ".join(case.shift_elements[number - 1].name for number in gear.engaged)
        yield f"<tr><td>{escape(gear.name)}</td><td>{escape(engaged)}</td></tr>"
    yield "</table>"
