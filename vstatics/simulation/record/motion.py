"""Result of a simulation: the motion over time, with events, energies and largest torques."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Annotated, Any, Literal, NamedTuple, Protocol

from vstatics.core.errors import Problem, plural
from vstatics.core.extras import AnyPicture, higher
from vstatics.core.model.empty import EMPTY
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.statics.result_arrays import Message
from vstatics.core.tables.answer import SOMETIMES
from vstatics.core.tables.html import shown

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

EventKind = Literal["locks", "slips", "reverses", "impact", "step"]


class Event(NamedTuple):
    """Event of a shift element, a load, a spring, a mechanism or a sequence."""

    time: float
    """Time of the event. [s]"""
    element: str
    event: EventKind
    energy: Annotated[float | None, SOMETIMES] = 0.0
    """Energy lost in an impact, otherwise 0; absent for a step of a sequence. [J]"""
    word: str = ""
    """Word for the event: dog clutches open and close, freewheels overrun, loads start."""
    step: Annotated[int | None, SOMETIMES] = None
    """Number of the completed step of a sequence."""


class Energy(NamedTuple):
    """Energy balance of a run, in J."""

    work: float
    """Work of external torques."""
    heat: Mapping[str, float]
    """Heat of friction by name: shift elements, springs, and links with a resistance."""
    heat_per_area: Annotated[Mapping[str, float], SOMETIMES]
    """Heat per friction area, by name of each shift element with a known area. [J/m^2]"""
    losses: Mapping[str, float]
    """Losses by name: of mechanisms, converters and dampers, and of links with drag."""
    kinetic: float
    """Change of the kinetic energy."""
    elastic: float
    """Change of the elastic energy."""
    impact: float
    """Energy lost in impacts."""
    balance: float
    """Work minus all other energies above; 0 except for numerical errors."""


class Damage(Protocol):
    """Fatigue damage of a component by the torque in a run."""

    @property
    def damage(self) -> float:
        """Damage by the run; the component fails at the `sum` of its fatigue strength [-]."""

    @property
    def repeats(self) -> float | None:
        """Number of runs to failure, None if unlimited [-]."""


class Peak(NamedTuple):
    """Largest torque of a component, by magnitude."""

    torque: float
    """Torque, with sign. [N*m]"""
    time: float
    """Time at which the torque is reached first. [s]"""


class Reached(NamedTuple):
    """Time, angle and distance at which a link first reaches a target speed."""

    link: str
    speed: float
    """Target speed. [rad/s]"""
    time: float
    """Time at which the speed is reached, NaN if never. [s]"""
    angle: float
    """Angle of the link at `time`. [rad]"""
    distance: float
    """Distance of the vehicle; NaN without a road or with a varying rolling radius. [m]"""


class Motion(NamedTuple):
    """Result of a simulation: motion over time, events and energies.

    Attributes
    ----------
    time : ndarray, shape (instants,)
        Instants of events, of the extremes of each column, multiples of a step, and enough others
        to draw the columns with straight lines. An instant of a jump appears twice. The last
        instant is the end of the run. [s]
    links, elements, devices : sequence of str
        Names of the columns of `speeds`, `slips` and `torques`, respectively.
    speeds : ndarray, shape (instants, links)
        Speeds of links. [rad/s]
    slips : ndarray, shape (instants, elements)
        Slip of shift elements: speed of the first link minus the speed of the second. [rad/s]
    torques : ndarray, shape (instants, devices)
        Torques of shift elements, mechanisms, springs and converters: the torque that the first
        link gives to the component, so the integral of torque times slip is heat. [N*m]
    heat : ndarray, shape (instants, elements)
        Heat of shift elements since the start. [J]
    events : sequence of Event
    energy : Energy
    peaks : mapping of str to Peak
    reached : sequence of Reached
    messages : sequence of Message
    stopped : Problem, optional
        Reason why the run ended early.
    asked : mapping of str to mapping of str to ndarray, shape (instants,)
        Additional columns, by table and row.
    damage : mapping of str to Damage
        Damage of components with a fatigue strength.
    beside : mapping of str to mapping of str to ndarray, shape (instants,)
        Tables for pictures and the report; empty for the method `tarasik`.
    case : Transmission
        Case of the scenario.
    dynamic_factors : mapping of str to float or None
        Largest torque of each component divided by its static torque, if the scenario has `static`;
        None where the static torque is 0.

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
    asked: Mapping[str, Mapping[str, Floats]] = EMPTY
    damage: Mapping[str, Damage] = EMPTY
    beside: Mapping[str, Mapping[str, Floats]] = EMPTY
    case: Transmission | None = None
    dynamic_factors: Mapping[str, float | None] = EMPTY

    def __repr__(self) -> str:
        """Return the name of the case, the duration and the number of events."""
        name = f" of {self.case.name!r}" if self.case and self.case.name else ""
        end = f"{self.time[-1]:.6g} s, {len(self.events)} {plural('event', len(self.events))}"
        stopped = ", stopped" if self.stopped else ""
        return f"<Motion{name}: {end}{stopped}>"

    def _repr_html_(self) -> str:
        return shown(higher("motion_grids")(self))

    def to_dataframe(self) -> pd.DataFrame:
        """Return the motion as a data frame, with the columns of `vstatics simulate -o run.csv`.

        Returns
        -------
        DataFrame
            A row for each instant, with the time [s] as index and as the first column, then speeds
            and slips [rad/s], torques [N*m] and additional columns. An instant at which a value
            jumps has two rows.

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
        (['time', 'speeds[1]', 'slips[B]', 'torques[B]'], 10.0)
        """
        table: pd.DataFrame = higher("motion_dataframe")(self)
        return table

    def to_xarray(self) -> xr.Dataset:
        """Return the motion over time as an xarray dataset, with names along the axes.

        Returns
        -------
        Dataset
            `speeds` over `time` and `link`, `slips` over `time` and `element` [rad/s], `torques`
            over `time` and `device` [N*m]. An instant at which a value jumps appears twice.

        Raises
        ------
        CaseError
            If xarray is missing.

        Examples
        --------
        >>> from vstatics import ShiftElement, Transmission
        >>> from vstatics.simulation import Capacity, Scenario, Start, constant, simulate
        >>> case = Transmission(1, [ShiftElement(1, name="B")], [], [], inertias={1: 2.0})
        >>> brake = {1: Capacity(constant(40.0))}
        >>> data = simulate(Scenario(case, 1.0, Start(speeds={1: 10.0}), brake)).to_xarray()
        >>> data.torques.dims, data.speeds.sel(link="1")[0].item()
        (('time', 'device'), 10.0)
        """
        dataset: xr.Dataset = higher("motion_dataset")(self)
        return dataset

    def plot(self, kind: str = "shift", **how: Any) -> AnyPicture:
        """Draw the run; a notebook displays the picture.

        Parameters
        ----------
        kind : {"shift", "plan"}
            Speeds, slips, torques and heat over time with the events, or the speed plan with the
            speeds of the run.
        **how
            Options of `vstatics.plot`, such as `width` [mm].

        Returns
        -------
        Picture

        Raises
        ------
        CaseError
            If matplotlib is missing, or if no speed, slip or torque changes.
        ValueError
            If `kind` is not a picture of a run.

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
