"""`Results`: named arrays of a case or its variants, and the messages about a case."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from typing import TYPE_CHECKING, Any, overload

import numpy as np

from vstatics.core.errors import listed
from vstatics.core.extras import AnyPicture, higher
from vstatics.core.model.transmission import SpeedOf, Transmission
from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.core.statics.freewheels import find_state
from vstatics.core.statics.losses import no_solution
from vstatics.core.statics.physical import PhysicalResults
from vstatics.core.statics.result_arrays import ARRAYS, GearTable, OperatingPoints
from vstatics.core.statics.state import GearState
from vstatics.core.statics.status import OK, Status, statuses

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

REMEMBERED_STATES = 64
"""Number of stored gear states. Tables and pictures of a case use the states several times."""


class Results(PhysicalResults):
    """Speeds, torques, losses and status of every gear.

    `ResultFields` documents the arrays, their axes and units; `PhysicalResults` adds the arrays in
    rpm, N*m and kW.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> results = solve(Transmission(2, [], [Mechanism(1, 2, 0, -2.5, 0.98)], [Gear(name="drive")]))
    >>> results, results.ratio, results["lossy_torques", "Mx", "drive"]
    (<Results: gears drive>, array([-2.5]), -2.45)
    """

    __slots__ = ()

    @overload
    def __getitem__(self, key: str) -> Floats: ...
    @overload
    def __getitem__(self, key: tuple[GearTable, str | int]) -> float: ...
    @overload
    def __getitem__(self, key: tuple[str, str | int, str | int]) -> float: ...
    @overload
    def __getitem__(self, key: tuple[str, Any] | tuple[str, Any, Any]) -> Any: ...
    def __getitem__(self, key: Any) -> Any:
        """Return an array, or a number, by names: ``results["speeds", "ring", "low"]``.

        For variants the result is an array over the variants instead of a number, although type
        checkers infer a float.
        """
        return higher("by_name")(self, key)

    def __eq__(self, other: object) -> bool:
        """Return whether two results have equal numbers, to the last bit."""
        if not isinstance(other, Results):
            return NotImplemented
        points, others = self.points, other.points
        return (
            self.case == other.case
            and self.messages == other.messages
            and _equal_arrays(_arrays_as_calculated(self), _arrays_as_calculated(other))
            and _equal_arrays(points.scales if points else {}, others.scales if others else {})
        )

    def __ne__(self, other: object) -> bool:
        """Return the opposite of ``==``, because `tuple.__ne__` would compare items."""
        return not self == other

    __hash__ = None  # type: ignore[assignment] # results hold arrays; == compares numbers

    def _repr_html_(self) -> str:
        shown: str = higher("results_html")(self)
        return shown

    def to_dataframe(self) -> pd.DataFrame:
        """Return all tables as a pandas table with a row for each variant and gear.

        Returns
        -------
        DataFrame
            Table of `vstatics.core.tables.dataframe.to_dataframe`: speeds, torques and powers
            relative to the input [-], with an operating point also in rpm, N*m and kW. A column is
            named by a table and its row, such as ``("speeds", "C1")``.

        Raises
        ------
        CaseError
            If pandas is missing.

        Examples
        --------
        >>> from vstatics import Gear, Mechanism, Transmission, solve
        >>> pair = Transmission(2, [], [Mechanism(1, 2, 0, -2.5)], [Gear(name="drive")])
        >>> solve(pair).to_dataframe()["ratio"].to_dict()
        {'drive': -2.5}
        """
        table: pd.DataFrame = higher("to_dataframe")(self)
        return table

    def to_xarray(self) -> xr.Dataset:
        """Return all tables as an xarray dataset, with names along the axes.

        Returns
        -------
        Dataset
            Dataset of `vstatics.core.tables.dataset.to_xarray`: dimensions `gear`, `link`, `device`
            and others; values relative to the input [-], with a load also in rpm, N*m and kW.

        Raises
        ------
        CaseError
            If xarray is missing.

        Examples
        --------
        >>> from vstatics import Gear, Mechanism, Transmission, solve
        >>> pair = Transmission(2, [], [Mechanism(1, 2, 0, -2.5)], [Gear(name="drive")])
        >>> solve(pair).to_xarray()["speeds"].sel(gear="drive", link="2").item()
        -0.4
        """
        dataset: xr.Dataset = higher("to_xarray")(self)
        return dataset

    def to_json(self, file: str = "") -> str:
        """Return the results as JSON text, equal to the output of `vstatics run -f json`.

        Parameters
        ----------
        file : str
            Path of the case file. The text contains only its last part, the file name.

        Examples
        --------
        >>> from vstatics import Gear, Mechanism, Transmission, solve
        >>> results = solve(Transmission(2, [], [Mechanism(1, 2, 0, 3.0)], [Gear()]))
        >>> results.to_json("cases/pair.yaml").splitlines()[1:4]
        ['  "format": "vstatics-result",', '  "version": 2,', '  "program": "vstatics 0.1.0",']
        """
        text: str = higher("to_json")(self, file)
        return text

    def plot(self, kind: str = "plan", **how: Any) -> AnyPicture:
        """Return a picture of the results, drawn by `vstatics.plot`, for a file or notebook.

        Parameters
        ----------
        kind : str
            Kind of picture: plan, lever, flow, stick and others, as in `vstatics.plot`.
        **how
            Options of `vstatics.plot`: `gear`, `width` [mm] and others.

        Raises
        ------
        CaseError
            If matplotlib is missing, or the case lacks what the picture shows.
        ValueError
            If the kind or gear does not exist.

        Examples
        --------
        >>> from vstatics import Gear, Mechanism, Transmission, solve
        >>> pair = Transmission(2, [], [Mechanism(1, 2, 0, -2.5)], [Gear(name="drive")])
        >>> solve(pair).plot("lever")
        <Picture lever of <Results: gears drive>>
        """
        picture: AnyPicture = higher("plot")(self, kind, **how)
        return picture

    def __repr__(self) -> str:
        """Return a short description with the case, the gears and the shape of the variants."""
        case, axes = self.case, self.ratio.shape[:-1]
        variants = f", variants of shape {axes}" if axes else ""
        name = f" of {case.name!r}" if case.name else ""
        return f"<Results{name}: gears {listed(self.gears, 12)}{variants}>"

    @property
    def gears(self) -> list[str]:
        """Names of the gears, in the order of the axis of gears.

        >>> from vstatics import Gear, Mechanism, Transmission, solve
        >>> solve(Transmission(2, [], [Mechanism(1, 2, 0, 3.0)], [Gear(name="drive")])).gears
        ['drive']
        """
        return [gear.name for gear in self.case.gears]

    @property
    def calculable(self) -> Booleans:
        """True for gears whose speeds and torques exist, as losses require, ``(..., gears)``."""
        return self.balanced & ~self.tied_up & ~self.conflict

    def existing(self, name: str) -> Floats:
        """Return an array by name, with NaN where the value has no meaning.

        Flags such as `idle` or `locked` are meaningful only in gears whose speeds and torques
        exist. In other gears the array itself contains 0, and this method returns NaN.

        >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
        >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)],
        ...                     [Gear([1]), Gear([], name="N")])
        >>> solve(case).existing("locked")
        array([ 0., nan])
        """
        array: Floats = getattr(self, name)
        if name not in ("idle", "consistent", "locked", "dragged"):
            return array
        exists = self.calculable
        if name in ("locked", "dragged"):
            exists = exists & ~self.undecided
        if np.count_nonzero(exists) == exists.size:
            return array.astype(np.float64)
        return np.where(exists[..., None] if name == "idle" else exists, array, np.nan)

    def gear(self, gear: int | str) -> GearState:
        """Return the state of a gear of a single case: speeds, torques, powers and status.

        Parameters
        ----------
        gear : int or str
            Number of the gear from 1, in the order of the case, or its name.

        Raises
        ------
        ValueError
            For arrays of variants, or if the gear does not exist.
        """
        if self.ratio.ndim != 1:
            raise ValueError(
                f"results of shape {self.ratio.shape}: a gear belongs to a single case"
            )
        return self.gear_at(self.case.gear_number(gear) - 1)

    def gear_at(self, index: int) -> GearState:
        """Return the state of a gear of a single case, by index.

        Each state is calculated only once.
        """
        state = _state_of(_CaseAtPoints(self.case, self.points), index)
        if self.points and self.undecided[index] and not state.search.undecided:
            # No torques of the gear suit efficiencies that depend on torque.
            lossy = no_solution(state.ideal, (math.nan,) * len(self.case.mechanisms))
            search = state.search._replace(lossy=lossy, undecided=True, locked=False, dragged=False)
            return state._replace(search=search)
        return state

    def status(self, number: int) -> Status:
        """Return the status of a gear of a single case, by number from 1."""
        index, case = number - 1, self.case
        output = case.gear_output(case.gears[index])
        all_statuses = statuses(
            tied_up=bool(self.tied_up[index]),
            conflict=bool(self.conflict[index]),
            output_speed=float(self.speeds[index, output - 1]),
            balanced=bool(self.balanced[index]),
            dragged=bool(self.dragged[index]),
            locked=bool(self.locked[index]),
            undecided=bool(self.undecided[index]),
            missing=int(self.missing[index]),
        )
        return all_statuses[0] if all_statuses else OK

    @property
    def with_freewheels_engaged(self) -> Transmission:
        """Case in which holding freewheels are replaced by engaged shift elements."""
        case = self.case
        if not case.freewheels:
            return case
        plain = [e._replace(kind="") if e.is_freewheel else e for e in case.shift_elements]
        gears = [
            gear._replace(
                engaged=(*gear.engaged, *(n for n in case.freewheels if holds[n - 1])),
            )
            for gear, holds in zip(case.gears, self.holds.tolist(), strict=True)
        ]
        return replace(case, shift_elements=plain, gears=gears)

    @property
    def with_numbers_only(self) -> Transmission:
        """Case for a deck: holding freewheels become engaged elements, and speeds numbers.

        A prescribed speed that is a multiple of another link's speed becomes a number, or is left
        out if indeterminate. The results must belong to one case, not to arrays of variants.
        """
        case = self.with_freewheels_engaged
        if not any(isinstance(v, SpeedOf) for gear in case.gears for v in gear.speeds.values()):
            return case
        gears = []
        for gear, speeds in zip(case.gears, self.speeds.tolist(), strict=True):
            numbers = {
                link: speeds[link - 1] if isinstance(given, SpeedOf) else given
                for link, given in gear.speeds.items()
            }
            known = {link: speed for link, speed in numbers.items() if not math.isnan(speed)}
            gears.append(gear._replace(speeds=known))
        return replace(case, gears=gears)

    @property
    def failed(self) -> bool:
        """True if a gear is tied up or has a freewheel conflict, so that the case fails."""
        return bool(np.count_nonzero(self.tied_up) or np.count_nonzero(self.conflict))


class _CaseAtPoints:
    """Cache key of a case and operating points, compared by identity for speed."""

    __slots__ = ("case", "points")

    def __init__(self, case: Transmission, points: OperatingPoints | None) -> None:
        self.case, self.points = case, points

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, _CaseAtPoints):
            return NotImplemented
        return self.case is other.case and self.points is other.points

    def __hash__(self) -> int:
        return hash((id(self.case), id(self.points)))


@lru_cache(maxsize=REMEMBERED_STATES)
def _state_of(calculated: _CaseAtPoints, index: int) -> GearState:
    case, points = calculated.case, calculated.points
    gear = points.gears[index] if points else case.gears[index]
    efficiencies: Sequence[Any] = [mechanism.efficiency for mechanism in case.mechanisms]
    if points and points.efficiencies:
        efficiencies = points.efficiencies[index]
    with np.errstate(all="ignore"):
        return find_state(
            case, gear, [mechanism.ratio for mechanism in case.mechanisms], efficiencies
        )


def _arrays_as_calculated(results: Results) -> dict[str, Any]:
    return {name: results.in_own_unit(name) for name in ARRAYS}


def _equal_arrays(some: Mapping[str, Any], others: Mapping[str, Any]) -> bool:
    return some.keys() == others.keys() and all(
        np.array_equal(array, others[name], equal_nan=True) for name, array in some.items()
    )


def expect_one_case(given: Results, function: str) -> None:
    """Refuse results of variants; `function` is the name of a function that needs a single case.

    Raises
    ------
    ValueError
        If the results have an axis of variants.
    """
    if given.ratio.ndim != 1:
        raise ValueError(f"{function} of results of shape {given.ratio.shape}: expected one case")
