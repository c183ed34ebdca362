"""Errors of a run that cannot go on, each with its cause and the path of the cause."""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import CaseError, Path, Problem, listed, quoted
from vstatics.core.model.parts import ShiftElement
from vstatics.core.model.springs import Spring
from vstatics.core.numerics.arrays import Floats
from vstatics.simulation.events.formula_corners import CURE_OF_JUMPS, FormulaCorners
from vstatics.simulation.events.margins import FOLLOWING, Watch
from vstatics.simulation.events.search import KIND_OF, Choice, Kind
from vstatics.simulation.events.sequences import SequenceProgress
from vstatics.simulation.events.unbounded import unbounded
from vstatics.simulation.system.equations import Equations
from vstatics.simulation.system.linearised import slopes_by_rate
from vstatics.simulation.system.matrices import Contact, MotionSystem
from vstatics.simulation.system.sight import Corner, control_path
from vstatics.simulation.tolerances import AHEAD_OF_STOP, BEYOND_ALL


class StopCauses(NamedTuple):
    """Search for the cause of a stop at an instant."""

    system: MotionSystem
    corners: FormulaCorners
    sequences: Sequence[SequenceProgress]
    time: float
    """Time at which the run stops. [s]"""

    def no_state(self, choices: Sequence[Choice]) -> CaseError:
        """Return the error if no combination of sticking and slipping states is admissible."""
        named = [(kind, index) for kind, index, _ in choices if kind != "pieces"]
        if corner := self._jump_of(named):
            return CaseError(
                "E601",
                f"at {self.time:.9g} s no state is admissible on either side of the jump of "
                f"{quoted(corner.text)}; {CURE_OF_JUMPS}",
                corner.path,
            )
        names = [self._name_of(kind, index) for kind, index in named]
        message = (
            f"at {self.time:.9g} s no state is consistent with the torques: neither sticking nor "
            f"slipping of {', '.join(names) or 'any component'}"
        )
        light = np.flatnonzero(~self.system.heavy.any(axis=0)).tolist()
        if not light:
            return CaseError("E602", message)
        links = listed([self.system.names[link] for link in light], 6)
        message += f"; the speeds of links without inertia can jump: give {links} an inertia"
        return CaseError("E602", message, ("case", "inertias"))

    def _jump_of(self, choices: Collection[tuple[Kind, int]]) -> Corner | None:
        """Return a jump of a formula that is reached now, or was reached by a law in `choices`."""
        meetings = self.corners.meetings
        now = meetings.latest(self.time)
        earlier = [place for place in meetings.times if place not in now]
        paths = {self._path_of(*choice) for choice in choices}
        for place in (*now, *earlier):
            corner = self.corners.all[place.corner]
            if self.corners.is_jump(place) and (place in now or corner.path in paths):
                return corner
        return None

    def endless(self, watch: Watch) -> CaseError:
        """Return the error if the state that a margin watches changes again and again."""
        name, path = self._owner(watch)
        message = (
            f"at {self.time:.9g} s {name} alternates between sticking and slipping without "
            "end, so the run cannot continue; let its torque change steadily with the speed, "
            "or give its links an inertia or a damper"
        )
        if watch.kind in FOLLOWING:
            message = (
                f"at {self.time:.9g} s {name} is reached again and again without end, so "
                f"the run cannot continue; {CURE_OF_JUMPS}"
            )
        return CaseError("E601", message, path)

    def too_small(self, equations: Equations, state: Floats, torque: float) -> Problem:
        """Return the reason for too small time steps, such as a torque that is invalid or jumps.

        Parameters
        ----------
        equations : Equations
        state : ndarray
            Last state that was reached.
        torque : float
            Large torque of the run. [N*m]
        """
        change = equations.derivative(self.time, state)
        for ahead in AHEAD_OF_STOP:
            at = self.time + ahead * self.system.scenario.duration
            moved = state + (at - self.time) * change
            if lacking := equations.lacking(at, moved):
                return lacking
            _, torques = equations.acting(at, state)
            if np.isfinite(moved).all():
                later = equations.acting(at, moved)[1]
                torques = np.where(np.isfinite(later), torques, later)
            for load, acting in zip(self.system.outside, torques.tolist(), strict=False):
                name = self.system.names[load.link]
                what = f"at {at:.6g} s the torque on {name} is {acting:g}"
                if not math.isfinite(acting):
                    return Problem("E605", f"{what}, expected a number", ("torques", name))
                if abs(acting) > BEYOND_ALL * torque:
                    return Problem("E606", f"{what} N*m: it grows without bound", ("torques", name))
            if problem := unbounded(equations, self.time, at, state):
                return problem
        return self._too_steep(equations, state)

    def _too_steep(self, equations: Equations, state: Floats) -> Problem:
        """Return a problem at the latest corner, or for the torque that changes most with speed."""
        for place in self.corners.meetings.latest(self.time)[:1]:
            corner = self.corners.all[place.corner]
            message = (
                f"at {self.time:.9g} s no time step is small enough at a corner of "
                f"{quoted(corner.text)}: next to it a value changes too steeply, or is not a number"
            )
            return Problem("E608", message, corner.path)
        message = (
            f"at {self.time:.9g} s no time step is small enough: a torque jumps with the speed, or "
            "changes too steeply with it; write dry friction of a load as `resistance`"
        )
        slopes = np.abs(slopes_by_rate(equations, self.time, state)[: self.system.layout.outside])
        if not slopes.any():
            return Problem("E608", message)
        name = self.system.names[self.system.outside[int(slopes.argmax())].link]
        return Problem("E608", message, ("torques", name))

    def _owner(self, watch: Watch) -> tuple[str, Path]:
        """Return the name of the owner of a margin, and its path in the scenario."""
        match watch.kind:
            case "split":
                return "a group of sticking components", ()
            case "corner":
                corner = self.corners.all[self.corners.watched[watch.of][0].corner]
                return quoted(corner.text), corner.path
            case "state":
                name = self.system.scenario.states[watch.of].name
                return f"the state {name}", ("states", name)
            case "awaited":
                progress = self.sequences[watch.of]
                return f"the sequence {progress.name}", progress.path
            case "piece":
                return self._name_of_law(watch.of), ()
        kind = KIND_OF.get(watch.kind) or "meshes"  # the power of a mechanism changes its direction
        return self._name_of(kind, watch.of), self._path_of(kind, watch.of)

    def _path_of(self, kind: Kind, index: int) -> Path:
        scenario, system = self.system.scenario, self.system
        device = getattr(system, kind)[index] if kind in ("contacts", "springs") else None
        if device is None:
            return ()
        if isinstance(device, Contact) and device.switch:
            return "torques", device.name
        key, name = path = control_path(device)
        given: Collection[int] = scenario.controls or ()
        parts: Sequence[ShiftElement | Spring] = system.case.shift_elements
        if key == "limits":
            given, parts = scenario.limits, system.case.springs
        return path if name in (parts[number - 1].name for number in given) else ()

    def _name_of(self, kind: Kind, index: int) -> str:
        return str(getattr(self.system, kind)[index].name)

    def _name_of_law(self, index: int) -> str:
        """Return the name of a law, by its index in `States.pieces`."""
        outside, frictions = self.system.layout.outside, self.system.layout.frictions
        if index >= frictions:
            return self.system.may_slip[index - frictions].name
        if index >= outside:
            return self.system.converters[index - outside].name
        return f"the torque on {self.system.names[self.system.outside[index].link]}"
