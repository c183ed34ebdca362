"""The same case as a torsional system: natural modes, reduction, simplification, response.

A gear is a `TorsionalSystem` of bodies, of elastic and of rigid devices, each with the row that
it has in the structural-distribution matrix (`system`). `coordinates` splits its motions into
free, massless and rigid ones; `natural` and `damped` solve for the modes, `torques` for the
torques of all devices; `gear_modes` tells them by name. `reduction` has all on one link,
`reduced_scheme` as masses and springs there, which `simplification` makes fewer; `forced` vibrates
under torques, `clutch` is dumped, `measured` corrects a case. The room needs scipy, an extra.

>>> from vstatics import Spring, Transmission, torsion
>>> shaft = Spring({1: 1, 2: -1}, stiffness=100.0, name="shaft")
>>> case = Transmission(2, [], [], [], springs=[shaft], inertias={1: 2.0, 2: 2.0})
>>> [gear] = torsion.modes(case)
>>> gear.modes[0].omega, gear.modes[0].torques
(10.0, {'shaft': 200.0})

Source: Tsitovich, Algin, Vehicle dynamics, Minsk, 1981 (chapters 1 to 3, appendices 1 to 3).
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from vstatics.torsion.clutch import dump
    from vstatics.torsion.forced import Harmonic, response
    from vstatics.torsion.gear_dump import gear_dumps
    from vstatics.torsion.gear_modes import modes
    from vstatics.torsion.measured import damping, identify
    from vstatics.torsion.reduced_scheme import gear_scheme
    from vstatics.torsion.reduction import reduce
    from vstatics.torsion.simplification import simplify

__all__ = [
    "Harmonic",
    "damping",
    "dump",
    "gear_dumps",
    "gear_scheme",
    "identify",
    "modes",
    "reduce",
    "response",
    "simplify",
]

_LATER = {
    "Harmonic": "forced",
    "damping": "measured",
    "dump": "clutch",
    "gear_dumps": "gear_dump",
    "gear_scheme": "reduced_scheme",
    "identify": "measured",
    "modes": "gear_modes",
    "reduce": "reduction",
    "response": "forced",
    "simplify": "simplification",
}
"""Names that are imported when somebody asks for them: most need scipy."""


def __getattr__(name: str) -> Any:
    if name in _LATER:
        return getattr(import_module(f"vstatics.torsion.{_LATER[name]}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return __all__
