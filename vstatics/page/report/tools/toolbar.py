"""The fields of the tools of a page, and what its script has to know of cases and units."""

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
"""What stands in the United States in place of a unit."""
CHOICES = {"relative": "relative", "si": "rpm, N*m, kW", "us": "US: rpm, lbf*ft, hp"}
"""What numbers can be in, the first one at first."""


def toolbar() -> Markup:
    """The choice of units, the filter by a link, what saves the page.

    >>> made = toolbar()
    >>> made.count("<option "), made.count('type="search"'), made.count("data-save=")
    (3, 1, 1)
    """
    options = (tag("option", tr(said), value=key) for key, said in CHOICES.items())
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
    """What the script has to know of a case; it stands within a section, made anew with that.

    Parameters
    ----------
    label : str
        Of one of several cases, as in ``data-case`` of their numbers.
    digits : int, optional
        After the point.
    """
    scales = gear_scales(case)
    known = {
        "links": case.link_names[: case.own_links],
        "gears": {
            gear.name: {key: value for key, value in own.items() if not math.isnan(value)}
            for gear, own in zip(case.gears, scales, strict=True)
        },
        "digits": digits,
    }
    return tag("div", hidden=True, data_of_case=str(compact(known)), data_label=label or False)


def _known() -> dict[str, Any]:
    """Of results their units, of units their words and sizes: each told where it is at home."""
    results = {one.key: _result(one.of, one.unit or one.with_load) for one in QUANTITIES}
    for name in POWERS.values():
        if name == LOSS_SHARE:
            continue
        relative = name.removesuffix("_kW")
        results[name] = _result("" if relative == name else relative, "kW", real=True)
    for name in ("input_power_kW", "output_power_kW"):
        results[name] = _result("", "kW", own=True)
    decimals = {one.key: one.decimals for one in QUANTITIES if one.decimals != 3}
    return {
        "results": {name: one for name, one in results.items() if one["unit"]},
        "decimals": decimals,
        "words": {key: tr(one.text) for key, one in UNITS.items()} | {"": tr(RELATIVE)},
        "places": {key: one.decimals for key, one in UNITS.items()},
        "us": {key: [1 / unit(word)[1], word] for key, word in US.items()},
    }


def _result(of: str, in_unit: str, *, real: bool = False, own: bool = False) -> dict[str, Any]:
    """What a result is in with a load; whether it is in that already, and repeats another one."""
    told = {"unit": in_unit}
    flags = {"own": own or bool(of), "repeats": bool(of), "real": real}
    return told | {key: True for key, holds in flags.items() if holds}


def compact(known: Mapping[str, Any]) -> Markup:
    """Plain data within a script, which no text of it ends.

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
