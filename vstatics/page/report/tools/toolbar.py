"""Input fields of the tools of a page, and data about cases and units for the script."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterable, Iterator, Mapping
from importlib.resources import files
from typing import Any

from vstatics.core.model.transmission import Transmission
from vstatics.core.readers.named.units import unit
from vstatics.core.statics.physical import gear_scales
from vstatics.core.tables.html import Markup, tag
from vstatics.core.tables.quantities import QUANTITIES, UNITS
from vstatics.core.texts import tr
from vstatics.page.report.tools.marks import LOSS_SHARE, POWERS, RELATIVE

US = {"Nm": "lbf*ft", "kW": "hp"}
"""Units customary in the United States, by the unit that they replace."""
CHOICES = {"relative": "relative", "si": "rpm, N*m, kW", "us": "US: rpm, lbf*ft, hp"}
"""Systems of units among which the reader chooses. The first is the default."""


def toolbar() -> Markup:
    """Return the toolbar: choice of units, filter by a link, and button for saving the page.

    >>> bar = toolbar()
    >>> bar.count("<option "), bar.count('type="search"'), bar.count("data-save=")
    (3, 1, 1)
    """
    options = (tag("option", tr(text), value=key) for key, text in CHOICES.items())
    return tag(
        "div",
        tag("label", tr("Units"), " ", tag("select", *options, id="units")),
        tag(
            "label",
            tr("Rows of link"),
            " ",
            tag("input", type="search", id="links", list="names-of-links", autocomplete="off"),
        ),
        tag("datalist", id="names-of-links"),
        tag("output", id="hidden-rows", role="status"),
        tag("button", tr("Save the page's results as JSON"), type="button", data_save="json"),
        tag("script", compact(_known()), type="application/json", id="known"),
        id="tools",
        class_="tools screen",
    )


def tools_of(case: Transmission, label: str = "", digits: int | None = None) -> Markup:
    """Return the data of a case for the script of the tools, as an HTML element.

    Parameters
    ----------
    label : str
        Letter of the case among two cases, as in ``data-case`` of its numbers.
    digits : int, optional
        Number of decimals.
    """
    scales = gear_scales(case)
    known = {
        "links": case.link_names[: case.own_links],
        "gears": {
            gear.name: {key: value for key, value in scale.items() if not math.isnan(value)}
            for gear, scale in zip(case.gears, scales, strict=True)
        },
        "digits": digits,
    }
    return tag("div", hidden=True, data_of_case=str(compact(known)), data_label=label or False)


def _known() -> dict[str, Any]:
    """Return the units of all results, and names, decimals and conversions of units."""
    results = {entry.name: _result(entry.of, entry.unit or entry.with_load) for entry in QUANTITIES}
    for name in POWERS.values():
        if name == LOSS_SHARE:
            continue
        relative = name.removesuffix("_kW")
        results[name] = _result("" if relative == name else relative, "kW", real=True)
    for name in ("input_power_kW", "output_power_kW"):
        results[name] = _result("", "kW", is_in_unit=True)
    decimals = {entry.name: entry.decimals for entry in QUANTITIES if entry.decimals != 3}
    return {
        "results": {name: entry for name, entry in results.items() if entry["unit"]},
        "decimals": decimals,
        "words": {key: tr(entry.text) for key, entry in UNITS.items()} | {"": tr(RELATIVE)},
        "places": {key: entry.decimals for key, entry in UNITS.items()},
        "us": {key: [1 / unit(word)[1], word] for key, word in US.items()},
    }


def _result(
    of: str, in_unit: str, *, real: bool = False, is_in_unit: bool = False
) -> dict[str, Any]:
    """Return the unit of a result at an operating point, with flags for its conversion."""
    entry = {"unit": in_unit}
    flags = {"own": is_in_unit or bool(of), "repeats": bool(of), "real": real}
    return entry | {key: True for key, holds in flags.items() if holds}


def compact(known: Mapping[str, Any]) -> Markup:
    """Return plain data as JSON that cannot end the enclosing script element.

    >>> compact({"links": ["</script>"]})
    '{"links":["\\\\u003c/script>"]}'
    """
    text = json.dumps(known, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    return Markup(text.replace("<", "\\u003c"))


def _resource(name: str) -> str:
    return (files(__package__) / name).read_text(encoding="utf-8")


def _together(names: Iterable[str]) -> Iterator[str]:
    yield '"use strict";\n(() => {\n'
    yield from (re.sub(r"(?m)^ +", "", _resource(name)) for name in names)
    yield "})();\n"


SCRIPT = Markup("".join(_together(("numbers.js", "units.js", "links.js", "saves.js"))))
STYLE = Markup(_resource("tools.css"))
