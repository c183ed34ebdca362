"""Types of the JSON output of `vstatics synth`, from which the schemas are derived."""

from __future__ import annotations

from typing import TypeAlias

from vstatics.synthesis.boxes.listing import BoxListing, ListedBox
from vstatics.synthesis.cli.box.command import BoxSearchEstimate
from vstatics.synthesis.cli.combinations_output import CombinationEstimate
from vstatics.synthesis.cli.structures import StructureCount, StructureEstimate
from vstatics.synthesis.gears.kinds import (
    EngagedSet,
    EngagedSetList,
    EngagedSetsOfAllPorts,
    EngagedSetsOfPorts,
)
from vstatics.synthesis.structures.growth import FoundScheme

StructuresAnswer: TypeAlias = FoundScheme | StructureCount | StructureEstimate
CombinationsAnswer: TypeAlias = (
    EngagedSetList | EngagedSet | EngagedSetsOfAllPorts | EngagedSetsOfPorts | CombinationEstimate
)
BoxAnswer: TypeAlias = BoxListing | ListedBox | BoxSearchEstimate
