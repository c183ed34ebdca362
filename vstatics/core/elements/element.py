"""A case as it is drawn: typical elements with teeth, in place of three-link mechanisms."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Literal, NamedTuple

from vstatics.core.elements.kinds import KINDS, Kind, Planetary
from vstatics.core.model.parts import HOUSING, NO_DAMPING, Damping, Mechanism, damping

Losses = Literal["meshes", "reduced"]
"""Whether losses are calculated at each mesh, or in as few mechanisms as the speeds need."""


class CentralWheel(NamedTuple):
    """A sun or ring of a group of planets.

    Attributes
    ----------
    member : str
        Its name within the element.
    link : int
        The link that it belongs to; 0 is the housing.
    teeth : int
    internal : bool
        A ring; a sun is external.
    rim : str
        The rim of a planet that it meshes with.

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
    """One planet of a set.

    Parameters
    ----------
    inertia : float
        About its own axis. [kg*m^2]
    mass : float
        [kg]
    radius : float
        Of its pin around the axis of the set; needed with a mass. [m]

    Examples
    --------
    >>> PlanetMass(0.001, mass=0.4, radius=0.06).inertia
    0.001
    """

    inertia: float = 0.0
    mass: float = 0.0
    radius: float = 0.0


class MeshEfficiency(NamedTuple):
    """Efficiency of a single mesh, both axes held [-].

    The defaults of gear meshes are those of the published comparison of loss models;
    the page Elements names all sources.

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
    """A typical element: what a drawing shows as one thing.

    Parameters
    ----------
    name : str
    kind : str
        One of `vstatics.core.elements.kinds.KINDS`.
    members : mapping of str to int
        Link of each member; 0 is the housing.
    teeth : mapping of str to number
        Of wheels and of rims of planets (diameters of a belt drive).
    planets : int, optional
        How many planets, or sets of meshed planets, stand around; for the checks of teeth.
    efficiency : float, optional
        Of the element as one mechanism, its carrier held; else it follows from the meshes. [-]
    back_efficiency : float, optional
        Of a worm pair that the wheel drives. [-]
    mesh_efficiency : mapping of mesh to float
        Fields of `MeshEfficiency` that differ from the case's in this element. [-]
    rims : mapping of planet to its rims with their teeth
        Of a `planet_group`.
    wheels : sequence of CentralWheel
        Of a `planet_group`.
    meshes : sequence of pairs of rims
        Of a `planet_group`: planets that mesh with one another.
    stiffness : float, optional
        Of an element that becomes one mechanism: torque on its first member by the twist of the
        mechanism's row, for vibration; rigid when not given. [N*m/rad]
    damping : Damping or float
        Beside the stiffness; a number is viscous. [N*m*s/rad]
    planet_masses : mapping of planet to PlanetMass
        Of each of the `planets`, for vibration.
    ratios : mapping of sun to number
        Of a Ravigneaux set whose teeth are not known yet: to the ring with the carrier held. [-]

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
        """Make a damping of a number."""
        object.__setattr__(self, "damping", damping(self.damping))

    @property
    def shape(self) -> Kind:
        """What its kind is made of."""
        return KINDS[self.kind]

    @property
    def planet_names(self) -> tuple[str, ...]:
        """Names of its planets, those of a group under `rims`; none of what has no planets."""
        if isinstance(self.shape, Planetary):
            return tuple(self.rims or self.shape.planets)
        return ("planet",) if "planet" in self.shape.toothed else ()

    def link(self, member: str) -> int:
        """The link of a member, the housing where it has none."""
        return self.members.get(member, HOUSING)


@dataclass(frozen=True)
class DrawingFields:
    """What a case draws: elements, and mechanisms that stand beside them; see `Drawing`.

    Parameters
    ----------
    links : int
        The case's own links; those of planets come after them.
    elements : sequence of Element
    mechanisms : sequence of Mechanism
        Those that are given as such.
    losses : {"meshes", "reduced"}, optional
        ``meshes`` where planets are shared when not given.
    mesh_efficiency : mapping of mesh to float
        Fields of `MeshEfficiency` that differ from the defaults. [-]
    """

    links: int
    elements: Sequence[Element] = ()
    mechanisms: Sequence[Mechanism] = ()
    losses: Losses | None = None
    mesh_efficiency: Mapping[str, float] = field(default_factory=dict)
