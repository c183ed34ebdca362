"""HTML of the interactive run, for the JavaScript of module `scripts`."""

from __future__ import annotations

import json

from vstatics.core.statics.results import Results
from vstatics.core.tables.html import Markup, tag
from vstatics.core.texts import heading, tr
from vstatics.pictures.paged.drawn import Drawn
from vstatics.pictures.paged.parts import SCREEN, figures
from vstatics.simulation.record.motion import Motion
from vstatics.simulation.report.runs.levers import moving_levers, moving_speeds
from vstatics.simulation.report.runs.record import page_run, recorded

_KEYS = (
    "Keys: left and right go to the instant before and after, with Shift to the event; page up "
    "and down by a tenth; + and - zoom, Escape shows the whole run. In a panel a pointer shows "
    "the numbers under it, a click stays there, a drag zooms."
)


_BUTTONS = {
    "zoom-in": "Zoom in",
    "zoom-out": "Zoom out",
    "whole": "Whole run",
    "csv": "Save CSV",
}


def moving_run(results: Results, motion: Motion, stick: Drawn) -> Markup:
    """Return panels, levers, stick diagram and tables of a run, all hidden without JavaScript.

    Parameters
    ----------
    results : Results
        Results of the case.
    stick : Drawn
        Stick diagram without a gear.
    """
    run = page_run(results, motion)
    start, end = float(motion.time[0]), float(motion.time[-1])
    slider = tag(
        "input", type="range", id="time", step="any", min=start, max=end, value=start,
        aria_describedby="run-keys",
    )  # fmt: skip
    label = tag("label", tr("Time, s"), for_="time")
    now = tag(
        "div",
        _states(motion),
        tag("div", *figures(stick, tr("Stick diagram at this time")), class_="stick-now"),
        moving_speeds(motion.links),
        tag("div", *moving_levers(results.case), class_="levers-now"),
        class_="run-now",
    )
    remark = tr(
        "The page has {kept} of {all} instants, with all digits. "
        "Between them it draws straight lines and reads numbers from these, which are within "
        "{off} of the range of each. Save CSV writes its instants within what is zoomed, "
        "for the panels that are open, in SI units as vstatics simulate does.",
        kept=len(run.motion.time),
        all=len(motion.time),
        off=f"{run.off:.1g}",
    )
    return tag(
        "div",
        tag("div", label, slider, tag("output", for_="time", class_="time-now"), class_="run-time"),
        tag("p", class_="gear-now", role="status"),
        tag(
            "div",
            *(
                tag("button", tr(caption), type="button", data_run=name)
                for name, caption in _BUTTONS.items()
            ),
            class_="run-buttons",
        ),
        now,
        tag("div", class_="run-panels"),
        tag("p", remark, class_="note"),
        tag("p", tr(_KEYS), class_="note", id="run-keys"),
        class_=f"{SCREEN} run-moves",
        hidden=True,
        data_record=json.dumps(
            recorded(results, run.motion),
            ensure_ascii=False,
            allow_nan=False,
            separators=(",", ":"),
        ),
    )


def _states(motion: Motion) -> Markup:
    heads = ("shift element", "", "slip, rpm", "torque, N·m")
    rows = (
        tag("tr", tag("th", name, scope="row"), *(tag("td") for _ in heads[1:]), data_element=name)
        for name in motion.elements
    )
    head = tag("tr", *(tag("th", heading(name) if name else "", scope="col") for name in heads))
    return tag("table", tag("thead", head), tag("tbody", *rows), class_="states-now")
