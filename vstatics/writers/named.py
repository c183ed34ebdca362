"""Writes cases as YAML and JSON; read again they are equal to the last bit."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

from vstatics.elements.drawing import drawing_of
from vstatics.model.transmission import Gear, Load, Mechanism, ShiftElement, Transmission

if TYPE_CHECKING:
    import yaml

_BREAKS = re.compile("[\x85\u2028\u2029]")  # YAML 1.1 takes these for ends of lines


class _OnOneLine(dict[str, Any]):
    """A mapping that YAML has in braces."""


def mapping(case: Transmission) -> dict[str, Any]:
    """A case as plain data, with the keys of its YAML and JSON.

    Keys that have their default are left out.

    Examples
    --------
    >>> from vstatics.model.transmission import Gear, Mechanism, ShiftElement, Transmission
    >>> case = Transmission(
    ...     2, [ShiftElement(1, 2)], [Mechanism(1, 2, 0, ratio=2.0)], [Gear([1])]
    ... )
    >>> mapping(case)["links"], mapping(case)["mechanisms"], mapping(case)["gears"]
    (2, {'D1': {'first': 1, 'second': 2, 'ratio': 2.0}}, {'1': {'engaged': ['F1']}})
    """
    links = _link_words(case)
    texts = {"name": case.name, "description": case.description, "source": case.source}
    data: dict[str, Any] = {key: str(text) for key, text in texts.items() if text}
    own = case.own_links
    data["links"] = own if _numbered(case) else links[1 : own + 1]
    if case.input != 1:
        data["input"] = links[case.input]
    if case.output != own:
        data["output"] = links[case.output]
    if case.idle != "exact":
        data["idle"] = str(case.idle)
    if case.coast:
        data["coast"] = True
    if case.load is not None:
        data["load"] = _load(case.load)
    if case.shift_elements:
        data["shift_elements"] = {
            str(element.name): _element(element, links) for element in case.shift_elements
        }
    mechanisms = case.mechanisms
    if drawing := drawing_of(case):
        from vstatics.writers import elements

        data |= elements.mapping(drawing, links)
        mechanisms = drawing.mechanisms
    if mechanisms or drawing is None:
        data["mechanisms"] = {str(m.name): _mechanism(m, links) for m in mechanisms}
    data["gears"] = {str(gear.name): _gear(gear, case, links) for gear in case.gears}
    return data


def write_yaml(case: Transmission) -> str:
    """A case as YAML; see `mapping`."""
    import yaml  # costs start-up time

    data = mapping(case)
    data["gears"] = {name: _OnOneLine(gear) for name, gear in data["gears"].items()}
    if "shift_elements" in data:
        data["shift_elements"] = {
            name: _OnOneLine(element) if isinstance(element, dict) else element
            for name, element in data["shift_elements"].items()
        }
    return yaml.dump(
        data,
        Dumper=_dumper(),
        sort_keys=False,
        allow_unicode=True,
        default_flow_style=None,
        width=100,
    )


def write_json(case: Transmission) -> str:
    """A case as JSON; see `mapping`."""
    import json  # costs start-up time

    return json.dumps(mapping(case), indent=2, ensure_ascii=False) + "\n"


def _numbered(case: Transmission) -> bool:
    """Whether the case's own links are called by their numbers."""
    own = case.own_links
    return list(case.link_names[:own]) == [str(number) for number in range(1, own + 1)]


def _link_words(case: Transmission) -> list[int | str]:
    """How each link is written, the housing first."""
    if _numbered(case):
        return ["housing", *range(1, case.links + 1)]
    return ["housing", *map(str, case.link_names)]


def _element(element: ShiftElement, links: list[int | str]) -> Any:
    """Its links alone, where there is nothing else to say."""
    ends = [links[element.first], links[element.second]]
    data: dict[str, Any] = {"kind": str(element.kind)} if element.kind else {}
    data["links"] = ends
    if element.drag:
        data["drag"] = float(element.drag)
    if element.capacity is not None:
        data["capacity"] = float(element.capacity)
    return data if len(data) > 1 else ends


def _mechanism(mechanism: Mechanism, links: list[int | str]) -> dict[str, Any]:
    data: dict[str, Any] = {"first": links[mechanism.first], "second": links[mechanism.second]}
    if mechanism.third:
        data["third"] = links[mechanism.third]
    data["ratio"] = float(mechanism.ratio)
    if mechanism.efficiency != 1:
        data["efficiency"] = float(mechanism.efficiency)
    if mechanism.back_efficiency is not None:
        data["back_efficiency"] = float(mechanism.back_efficiency)
    if mechanism.planet_ratio is not None:
        data["planet_ratio"] = float(mechanism.planet_ratio)
    return data


def _gear(gear: Gear, case: Transmission, links: list[int | str]) -> dict[str, Any]:
    data: dict[str, Any] = {}
    if gear.engaged:
        data["engaged"] = [str(case.shift_elements[number - 1].name) for number in gear.engaged]
    for key, given in (("speeds", gear.speeds), ("torques", gear.torques)):
        if given:
            data[key] = {links[link]: float(value) for link, value in given.items()}
    if gear.drag:
        data["drag"] = {links[link]: float(torque) for link, torque in gear.drag.items()}
    if gear.open_drag:
        data["open_drag"] = {
            str(case.shift_elements[number - 1].name): float(torque)
            for number, torque in gear.open_drag.items()
        }
    for key, end in (("input", gear.input), ("output", gear.output)):
        if end is not None:
            data[key] = links[end]
    if gear.load is not None:
        data["load"] = _load(gear.load)
    return data


def _load(load: Load) -> dict[str, Any]:
    units = {"speed": "rpm", "torque": "N*m"}
    return {
        quantity: f"{float(value)!r} {units[quantity]}"
        for quantity, value in load._asdict().items()
        if value is not None
    }


def _dumper() -> type[yaml.SafeDumper]:
    """A dumper that writes texts of several lines as such, and no aliases."""
    import yaml

    class Dumper(yaml.SafeDumper):
        def ignore_aliases(self, data: Any) -> bool:
            del data
            return True

    def text(dumper: yaml.SafeDumper, data: str) -> yaml.ScalarNode:
        style = '"' if _BREAKS.search(data) else "|" if "\n" in data else None
        return dumper.represent_scalar("tag:yaml.org,2002:str", data, style=style)

    def on_one_line(dumper: yaml.SafeDumper, data: _OnOneLine) -> yaml.MappingNode:
        return dumper.represent_mapping("tag:yaml.org,2002:map", data, flow_style=True)

    Dumper.add_representer(str, text)
    Dumper.add_representer(_OnOneLine, on_one_line)
    return Dumper
