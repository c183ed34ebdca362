"""The efficiency of a gear mesh where a case gives none."""

from __future__ import annotations

from typing import NamedTuple


class MeshEfficiency(NamedTuple):
    """Efficiency of a single mesh, both axes held [-].

    The defaults of gear meshes are those of the published comparison of loss models;
    see docs/elements.md for all sources.
    """

    external: float = 0.98
    internal: float = 0.99
    bevel: float = 0.97
