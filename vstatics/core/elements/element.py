"""Gear sets of a case as drawn in a stick diagram, with teeth."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Literal, NamedTuple

from vstatics.core.elements.kinds import KINDS, Kind, Planetary
from vstatics.core.model.parts import HOUSING, NO_DAMPING, Damping, Mechanism, damping

Losses = Literal["meshes", "reduced"]
"""Location of losses: each mesh, or the smallest number of equivalent mechanisms."""


class CentralWheel(NamedTuple):
    """Sun gear or ring gear of a group of planets.

    Attributes
    ----------
    member : str
        Name within the gear set.
    link : int
        Link of the gear; 0 is the housing.
    teeth : int
        Number of teeth.
    internal : bool
        True for a ring gear, False for a sun gear.
    rim : str
        Name of the planet gear (rim) that meshes with the gear.

    Examples
    --------
    >>> CentralWheel("ring", 2, 75, internal=True, rim="planet").teeth
    75
    """

    member: str
    link: int
    teeth: int
    internal: bool
    rim: str


class PlanetMass(NamedTuple):
    """Inertia and mass of a planet of a gear set.

    Parameters
    ----------
    inertia : float
        Moment of inertia about the planet's own axis. [kg*m^2]
    mass : float
        Mass of the planet. [kg]
    radius : float
        Distance of the planet pin from the axis of the gear set; required with a mass. [m]

    Examples
    --------
    >>> PlanetMass(0.001, mass=0.4, radius=0.06).inertia
    0.001
    """

    inertia: float = 0.0
    mass: float = 0.0
    radius: float = 0.0


class MeshEfficiency(NamedTuple):
    """Efficiency of a single mesh with both axes held [-].

    The default values are from a published comparison of loss models. The page Elements of the
    documentation lists all sources.

    Examples
    --------
    >>> MeshEfficiency(external=0.985)
    MeshEfficiency(external=0.985, internal=0.99, bevel=0.97)
    """

    external: float = 0.98
    internal: float = 0.99
    bevel: float = 0.97


@dataclass(frozen=True)
class Element:
    """Gear set of a case: a single symbol of the stick diagram.

    Parameters
    ----------
    name : str
        Name of the gear set.
    kind : str
        Kind, a key of `vstatics.core.elements.kinds.KINDS`.
    members : mapping of str to int
        Link of each member; 0 is the housing.
    teeth : mapping of str to number
        Number of teeth of each gear or planet rim; diameters for a belt drive, in any unit.
    planets : int, optional
        Number of equal planets, or of equal groups of meshing planets.
    efficiency : float, optional
        Efficiency of the whole gear set with the carrier held. Default: calculated from the meshes.
        [-]
    back_efficiency : float, optional
        Efficiency of a worm pair driven by its wheel; 0 if self-locking. [-]
    mesh_efficiency : mapping of mesh to float
        Fields of `MeshEfficiency` that replace the efficiencies of the case. [-]
    rims : mapping of planet to its rims with their teeth
        Names and teeth of the rims (gears) of each planet of a `planet_group`.
    wheels : sequence of CentralWheel
        Central gears of a `planet_group`.
    meshes : sequence of pairs of rims
        Rims of planets of a `planet_group` that mesh with each other.
    stiffness : float, optional
        Stiffness of a gear set with a single mechanism, for vibration and simulation: torque on its
        first member divided by the elastic deflection of that member with the others held. Default:
        rigid. [N*m/rad]
    damping : Damping or float
        Damping parallel to the stiffness; a number is viscous. [N*m*s/rad]
    planet_masses : mapping of planet to PlanetMass
        Mass and inertia of a single planet, for vibration and simulation. The gear set has
        `planets` such planets.
    ratios : mapping of sun to number
        Speed ratios of a Ravigneaux set with unknown teeth: sun to ring with the carrier held. [-]

    Examples
    --------
    >>> members = {"sun": 1, "ring": 2, "carrier": 3}
    >>> Element("P", "planetary", members, {"sun": 30, "ring": 75}).teeth["ring"]
    75
    """

    name: str
    kind: str
    members: Mapping[str, int]
    teeth: Mapping[str, float] = field(default_factory=dict)
    planets: int | None = None
    efficiency: float | None = None
    back_efficiency: float | None = None
    mesh_efficiency: Mapping[str, float] = field(default_factory=dict)
    rims: Mapping[str, Mapping[str, int]] = field(default_factory=dict)
    wheels: Sequence[CentralWheel] = ()
    meshes: Sequence[tuple[str, str]] = ()
    stiffness: float | None = None
    damping: Damping | float = NO_DAMPING
    planet_masses: Mapping[str, PlanetMass] = field(default_factory=dict)
    ratios: Mapping[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        object.__setattr__(self, "damping", damping(self.damping))

    @property
    def shape(self) -> Kind:
        """Description of this kind of gear set: its members, toothed gears and meshes."""
        return KINDS[self.kind]

    @property
    def planet_names(self) -> tuple[str, ...]:
        """Names of the planets, which for a `planet_group` are the keys of `rims`."""
        if isinstance(self.shape, Planetary):
            return tuple(self.rims or self.shape.planets)
        return ("planet",) if "planet" in self.shape.toothed else ()

    def link(self, member: str) -> int:
        """Return the link number of a member; 0 (the housing) if the member is absent."""
        return self.members.get(member, HOUSING)


@dataclass(frozen=True)
class DrawingFields:
    """Fields of `Drawing`: gear sets and further mechanisms of a case.

    Parameters
    ----------
    links : int
        Number of links of the case. Links of planets, not included, have larger numbers.
    elements : sequence of Element
        Gear sets.
    mechanisms : sequence of Mechanism
        Mechanisms in addition to the gear sets.
    losses : {"meshes", "reduced"}, optional
        Where losses occur. Default: ``meshes`` for gear sets in which more than two central gears
        share planets, else ``reduced``.
    mesh_efficiency : mapping of mesh to float
        Fields of `MeshEfficiency` that replace the defaults. [-]
    """

    links: int
    elements: Sequence[Element] = ()
    mechanisms: Sequence[Mechanism] = ()
    losses: Losses | None = None
    mesh_efficiency: Mapping[str, float] = field(default_factory=dict)
