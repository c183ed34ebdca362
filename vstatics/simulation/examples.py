"""Names of the shipped scenarios, from which type checkers infer the result of `example`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, Protocol, TypeAlias, overload

if TYPE_CHECKING:
    from vstatics.core.model.transmission import Transmission
    from vstatics.simulation.scenario.parts import Scenario

ScenarioName: TypeAlias = Literal[
    "scenarios/8hp70-downshift",
    "scenarios/8hp70-shifts",
    "scenarios/8hp70-upshift",
    "scenarios/8l90-shifts",
    "scenarios/gf4a-upshifts",
    "scenarios/moskvich-samples",
    "scenarios/moskvich-start",
    "scenarios/tarasik-box",
    "scenarios/tarasik-set-lock",
    "scenarios/tarasik-set-upshift",
    "scenarios/tarasik-truck",
]
"""Names of the shipped scenarios."""


class Example(Protocol):
    """Type of `vstatics.example`, which returns a case or a scenario, depending on its name."""

    @overload
    def __call__(self) -> list[str]: ...

    @overload
    def __call__(self, name: ScenarioName) -> Scenario: ...

    @overload
    def __call__(self, name: str) -> Transmission | Any: ...
