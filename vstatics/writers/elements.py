"""Typical elements as plain data, with the keys of their YAML and JSON."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from vstatics.elements.drawing import Drawing
from vstatics.elements.element import CentralWheel, Element

Words = Sequence[int | str]


def mapping(drawing: Drawing, links: Words) -> dict[str, Any]:
    """The keys of a case that tell of its elements.

    Parameters
    ----------
    links : sequence
        How each link is written, the housing first.
    """
    data: dict[str, Any] = {}
    if drawing.losses is not None:
        data["losses"] = str(drawing.losses)
    if drawing.mesh_efficiency:
        data["mesh_efficiency"] = _floats(drawing.mesh_efficiency)
    data["elements"] = {str(one.name): _element(one, links) for one in drawing.elements}
    return data


def _element(element: Element, links: Words) -> dict[str, Any]:
    data: dict[str, Any] = {"kind": str(element.kind)}
    data |= {str(member): links[link] for member, link in element.members.items()}
    if element.rims:
        data["rims"] = {str(planet): dict(rims) for planet, rims in element.rims.items()}
        for key, internal in (("suns", False), ("rings", True)):
            wheels = [w for w in element.wheels if w.internal == internal]
            if wheels:
                data[key] = [_wheel(wheel, links) for wheel in wheels]
        if element.meshes:
            data["meshes"] = [list(map(str, pair)) for pair in element.meshes]
    if element.teeth:
        size = getattr(element.shape, "size", "teeth")
        data[size] = {str(name): count for name, count in element.teeth.items()}
    if element.planets is not None:
        data["planets"] = element.planets
    if element.back_efficiency is not None and element.efficiency is not None:
        data["efficiency"] = {
            "worm": float(element.efficiency),
            "wheel": float(element.back_efficiency),
        }
    elif element.efficiency is not None:
        data["efficiency"] = float(element.efficiency)
    if element.mesh_efficiency:
        data["mesh_efficiency"] = _floats(element.mesh_efficiency)
    return data


def _wheel(wheel: CentralWheel, links: Words) -> dict[str, Any]:
    return {"link": links[wheel.link], "teeth": wheel.teeth, "rim": str(wheel.rim)}


def _floats(given: dict[str, float] | Any) -> dict[str, float]:
    return {str(mesh): float(value) for mesh, value in given.items()}
