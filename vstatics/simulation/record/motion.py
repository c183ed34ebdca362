"""What a simulation gives."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Annotated, Any, Literal, NamedTuple, Protocol

from vstatics.core.errors import Problem, plural
from vstatics.core.extras import AnyPicture, higher
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.statics.result_arrays import Message
from vstatics.core.tables.answer import SOMETIMES
from vstatics.core.tables.html import shown

if TYPE_CHECKING:
    import pandas as pd

EventKind = Literal["locks", "slips", "reverses", "impact", "step"]


class Event(NamedTuple):
    """What happens to an element, to a load, to a mechanism, or in a sequence, at an instant."""

    time: float
    """[s]"""
    element: str
    event: EventKind
    energy: Annotated[float | None, SOMETIMES] = 0.0
    """Lost at once, in an impact; None of a step. [J]"""
    word: str = ""
    """Usual word: dog clutches open and close, freewheels overrun, loads start, mechanisms that
    their friction holds still stick and move."""
    step: Annotated[int | None, SOMETIMES] = None
    """The number of the step of a sequence that was done."""


class Energy(NamedTuple):
    """Where the work went, in J."""

    work: float
    """Of outside torques."""
    heat: Mapping[str, float]
    """Of friction, by shift element, by link for its resistances."""
    heat_per_area: Annotated[Mapping[str, float], SOMETIMES]
    """Of elements whose area is known. [J/m^2]"""
    losses: Mapping[str, float]
    """Of converters, dampers, drag, meshes, by name."""
    kinetic: float
    """Change."""
    elastic: float
    """Change."""
    impact: float
    """Lost at once."""
    balance: float
    """Work less all the rest."""


class Damage(Protocol):
    """Fatigue damage of a device by its torque in a run."""

    @property
    def damage(self) -> float:
        """Part of the damage at which the device fails [-]."""

    @property
    def repeats(self) -> float | None:
        """Number of runs that the device bears; None: any number [-]."""


class Peak(NamedTuple):
    """The largest torque of a device, by magnitude."""

    torque: float
    """With its sign. [N*m]"""
    time: float
    """[s]"""


class Reached(NamedTuple):
    """When a link reached a speed."""

    link: str
    speed: float
    """[rad/s]"""
    time: float
    """[s]; NaN: it did not"""
    angle: float
    """Through which it had turned. [rad]"""
    distance: float
    """On a road; NaN without one, or where the radius of the wheels changes. [m]"""


class Motion(NamedTuple):
    """The course of a simulation.

    Attributes
    ----------
    time : ndarray, shape (instants,)
        Events, the largest and least values of each column, multiples of a step, and so many
        others that straight lines between them draw the columns; an instant of a jump
        stands twice, the last is the duration. [s]
    links, elements, devices : sequence of str
        Names of the columns of `speeds`, of `slips`, of `torques`.
    speeds : ndarray, shape (instants, links)
        [rad/s]
    slips : ndarray, shape (instants, elements)
        Of shift elements: speed of the first link less that of the second. [rad/s]
    torques : ndarray, shape (instants, devices)
        Of shift elements, mechanisms, springs, converters: on the first link, given to the
        device, so the integral of torque times slip is heat. [N*m]
    heat : ndarray, shape (instants, elements)
        Of shift elements up to an instant. [J]
    events : sequence of Event
    energy : Energy
    peaks : mapping of str to Peak
    reached : sequence of Reached
    messages : sequence of Message
    stopped : Problem, optional
        Why the run ends before its duration.
    asked : mapping of str to mapping of str to ndarray, shape (instants,)
        Columns that were asked for, by table and row.
    damage : mapping of str to DeviceDamage
        Of devices that have a fatigue strength.
    beside : mapping of str to mapping of str to ndarray, shape (instants,)
        What pictures show besides, as of `record.beside`; none of the method `tarasik`.
    case : Transmission
        What moves, as `simulate` had it.

    Examples
    --------
    >>> from vstatics import ShiftElement, Transmission
    >>> from vstatics.simulation import Capacity, Scenario, Start, constant, simulate
    >>> case = Transmission(1, [ShiftElement(1, name="B")], [], [], inertias={1: 2.0})
    >>> motion = simulate(
    ...     Scenario(case, 1.0, Start(speeds={1: 10.0}), {1: Capacity(constant(40.0))})
    ... )
    >>> motion, motion.speeds[[0, -1], 0].tolist()
    (<Motion: 1 s, 1 event>, [10.0, 0.0])
    """

    time: Floats
    links: tuple[str, ...]
    elements: tuple[str, ...]
    devices: tuple[str, ...]
    speeds: Floats
    slips: Floats
    torques: Floats
    heat: Floats
    events: tuple[Event, ...]
    energy: Energy
    peaks: Mapping[str, Peak]
    reached: tuple[Reached, ...] = ()
    messages: tuple[Message, ...] = ()
    stopped: Problem | None = None
    asked: Mapping[str, Mapping[str, Floats]] = MappingProxyType({})
    damage: Mapping[str, Damage] = MappingProxyType({})
    beside: Mapping[str, Mapping[str, Floats]] = MappingProxyType({})
    case: Transmission | None = None

    def __repr__(self) -> str:
        """Of what, how long, and how much happened; not all its numbers."""
        name = f" of {self.case.name!r}" if self.case and self.case.name else ""
        end = f"{self.time[-1]:.6g} s, {len(self.events)} {plural('event', len(self.events))}"
        stopped = ", stopped" if self.stopped else ""
        return f"<Motion{name}: {end}{stopped}>"

    def _repr_html_(self) -> str:
        """Events, energy, largest torques, speeds reached, for a notebook."""
        return shown(higher("motion_grids")(self))

    def to_dataframe(self) -> pd.DataFrame:
        """The course as a pandas table, with the columns of `vstatics simulate -o run.csv`.

        Returns
        -------
        DataFrame
            A row for each instant, with its time as index [s]; speeds and slips [rad/s], torques
            [N*m], then what was asked for. An instant of a jump has two rows.

        Raises
        ------
        CaseError
            If pandas is missing.

        Examples
        --------
        >>> from vstatics import ShiftElement, Transmission
        >>> from vstatics.simulation import Capacity, Scenario, Start, constant, simulate
        >>> case = Transmission(1, [ShiftElement(1, name="B")], [], [], inertias={1: 2.0})
        >>> brake = {1: Capacity(constant(40.0))}
        >>> frame = simulate(Scenario(case, 1.0, Start(speeds={1: 10.0}), brake)).to_dataframe()
        >>> list(frame), float(frame["speeds[1]"].iloc[0])
        (['speeds[1]', 'slips[B]', 'torques[B]'], 10.0)
        """
        table: pd.DataFrame = higher("motion_dataframe")(self)
        return table

    def plot(self, kind: str = "shift", **how: Any) -> AnyPicture:
        """A picture of the run, which a notebook shows: `vstatics.plot` of its case with it.

        Parameters
        ----------
        kind : {"shift", "plan"}
            Speeds, slips, torques, heat over time with the events, or the kinematic plan with the
            speeds that the run had.
        **how
            As of `vstatics.plot`: `width` [mm] and others.

        Raises
        ------
        CaseError
            If matplotlib is missing, or nothing moves.
        ValueError
            If this is no kind of a run.

        Examples
        --------
        >>> from vstatics import ShiftElement, Transmission
        >>> from vstatics.simulation import Capacity, Scenario, Start, constant, simulate
        >>> case = Transmission(1, [ShiftElement(1, name="B")], [], [], inertias={1: 2.0})
        >>> brake = {1: Capacity(constant(40.0))}
        >>> simulate(Scenario(case, 1.0, Start(speeds={1: 10.0}), brake)).plot()
        <Picture shift of <Results: gears 1>>
        """
        picture: AnyPicture = higher("plot_motion")(self, kind, **how)
        return picture
