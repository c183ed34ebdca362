"""`vstatics plot`: a picture of a case."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Sequence
from functools import partial
from typing import cast

import click

from vstatics.core.cli.shared import cases as arguments
from vstatics.core.cli.shared import files, formats, texts
from vstatics.core.cli.shared.cases import CalculatedCase, CaseOptions, calculate
from vstatics.core.cli.shared.documents import is_a
from vstatics.core.cli.shared.exit_status import DONE, FAILED
from vstatics.core.cli.shared.one_or_many import carry_out
from vstatics.core.cli.shared.options import refuse
from vstatics.core.cli.shared.texts import Job
from vstatics.core.cli.shared.values import numbers, shown_speeds, told, value, wrong_value
from vstatics.core.errors import CaseError, ReadError, of_file
from vstatics.core.jobs.files import STDOUT, is_stream
from vstatics.core.jobs.input_files import TABLE_BYTES
from vstatics.core.statics.results import Results
from vstatics.core.statics.solve import solve
from vstatics.core.tables.suffixes import known, suffix_of
from vstatics.core.texts import Language
from vstatics.pictures import OF_ORDERS, OF_RUNS, OF_VIBRATION, OPTIONS, PICTURES, misplaced, pages
from vstatics.pictures.drawing.files import FORMATS, Format
from vstatics.pictures.drawing.lengths import page_width
from vstatics.pictures.drawing.style import PAGE_HEIGHT, Excitation, Style
from vstatics.simulation.cli.scenario_run import named_by_run, run_of
from vstatics.sweep.pictures import SWEEP_PICTURES
from vstatics.sweep.pictures.columns import DrawnColumns
from vstatics.synthesis.cli.found_boxes import plot_boxes

BOXES = "boxes"
"""The kind of picture that shows no case, but a document of found boxes."""
_WITHOUT_GEARS = {
    BOXES: "found boxes are shown with all their gears",
    "shift": OPTIONS["gear"][1],
    **dict.fromkeys(SWEEP_PICTURES, "expected --by gear, or the column of a gear"),
}
"""Kinds of which no gear can be picked, and what is said then."""


@click.command()
@arguments.optional_argument
@click.option(
    "-k",
    "--kind",
    type=click.Choice([*PICTURES, BOXES, *SWEEP_PICTURES]),
    metavar="KIND",
    required=True,
    help="What is drawn, one of the above.",
)
@arguments.required_output(
    "SVG, PNG or PDF by the suffix; - is standard output, for SVG; two cases go to one sheet, "
    "several to a directory, as SVG. Further pages are FILE-2.svg, FILE-3.svg, or in the same "
    "PDF; - is one page of any height."
)
@arguments.some_gears
@click.option("--wheels", is_flag=True, help="Stick diagrams: names and teeth of wheels.")
@click.option("--merge", is_flag=True, help="Levers: two sets with two common links are one.")
@click.option(
    "--order",
    type=click.Choice(["free", "as-given"]),
    default="free",
    help="Order of the sets in stick diagrams. as-given keeps that of the case, also at the cost "
    "of crossings; if no such layout is found, the title says so.",
)
@click.option(
    "--ratios",
    metavar="U,...",
    callback=value(numbers("ratios of gears such as 2.6,1.7,-4", -math.inf)),
    help="Of a plan: of these ratios alone, without a case.",
)
@click.option("--x", metavar="COLUMN", default="", help="Of a sweep: what is across.")
@click.option(
    "--y",
    metavar="COLUMN",
    multiple=True,
    help="Of a map what is upward; of curves and histograms the columns that are drawn.",
)
@click.option("--z", metavar="COLUMN", default="", help="Of a map: the column that has contours.")
@click.option(
    "--by",
    metavar="COLUMN",
    default="",
    help="Of a sweep: a map, line or histogram for each value, or gear.",
)
@click.option("--out", metavar="LIST", default="", help="Of a shift: more columns, as of simulate.")
@click.option(
    "--orders",
    metavar="N,...",
    callback=value(numbers("an order above 0", math.ulp(0.0)), "--orders"),
    help="Of campbell and response: orders of the speed; else those of the engine.",
)
@click.option(
    "--speed",
    metavar="A:B",
    callback=value(told(shown_speeds), "--speed"),
    help="Of campbell and response: range of speeds in rpm, or with a unit behind each.",
)
@click.option("--at", metavar="LINK", default="", help="Of a response: the link; else the input.")
@click.option(
    "--width",
    metavar="LENGTH",
    default="170mm",
    show_default=True,
    callback=value(told(page_width)),
    help="Of a page: 80mm to 1200mm, in mm, cm, in or pt.",
)
@click.option("--dark", is_flag=True, help="Light on dark, for a screen.")
@arguments.settings
@arguments.language("axes and titles")
def plot(
    cases: tuple[str, ...],
    kind: str,
    output: str,
    gears: tuple[str, ...],
    wheels: bool,
    merge: bool,
    order: str,
    ratios: list[float] | None,
    x: str,
    y: tuple[str, ...],
    z: str,
    by: str,
    out: str,
    orders: list[float] | None,
    speed: tuple[float, float] | None,
    at: str,
    width: float,
    dark: bool,
    settings: CaseOptions,
    lang: Language,
) -> int:
    """Draw a picture of each CASE: a deck, YAML, JSON or a scenario; - is standard input.

    \b
    plan         speeds of all links over the output speed: the generalised
                 kinematic plan
    lever        the lever analogy: sets as levers, their joints, torques and
                 speeds, gear by gear
    flow         power of each gear in bands, losses, circulating power
    structure    mechanisms as boxes, links as wires, clutches and brakes
    stick        the stick diagram of elements, or of what may be planetary sets
    efficiency   efficiency by gear, with the losses of each mechanism
    modes        natural modes of a gear, the first unless --gear says which:
                 shapes over the links, shares of the energy
    campbell     natural frequencies of all gears over the input speed, and
                 where its orders meet them
    response     amplitude of the input over its speed under 1 N*m, a line for
                 each order, gear by gear
    dump         the largest torque when the clutch is dumped, by gear
    shift        the run of a scenario over time: gear, speeds, slips, torques
                 with capacities, vehicle or output, heat, with its events
    traction     force at the wheels of the `vehicle` over its speed, gear by
                 gear with all losses; resistance on slopes of 0 to 30 %
    sawtooth     engine speed over road speed, gear by gear
    steps        forward gears on a logarithmic line of ratios, beside
                 geometric and progressive steps
    boxes        what `synth box -f json` found, in place of a case: mean loss
                 over the largest torque, families, stick diagrams
    map          what `sweep -o` wrote, in place of a case: contours of a
                 column over two varied numbers, and where operation ends
    curves       of the same: columns over one varied number, a line for each
                 gear, or for each value of another one
    histogram    of the same, and of what `simulate --samples -o` wrote: how
                 often numbers of a column fall into parts of its range

    \b
    Of a scenario plan shows its run, too; other kinds show its case.
    Two cases to one FILE are on one sheet, over one another, or beside each
    other where there is room: panels A and B.

    Letters keep their size of 8 pt: what is wider than a page goes on below, what is
    higher than 240 mm on a further page.

    \b
    Examples:
      vstatics plot gearbox.yaml --kind plan -o plan.svg
      vstatics plot --kind plan --ratios 2.6,1.7,1,-4 -o wanted.svg
      vstatics plot gearbox.yaml --kind lever --gear 2 -o second.pdf
      vstatics plot old.yaml new.yaml --kind efficiency -o compared.svg
      vstatics plot upshift.yaml --kind shift -o upshift.png
      vstatics plot upshift.yaml --kind shift --out 'vehicle_jerk, heat' -o up.png
      vstatics plot car.yaml --kind traction -o forces.svg
      vstatics plot loads.csv --kind map --z 'efficiency[low]' -o map.svg
      cat gearbox.dat | vstatics plot - --kind efficiency -o losses.png --dark

    Needs matplotlib: pip install "vstatics[plot]"; modes, campbell,
    response and dump need scipy too: "vstatics[plot,torsion]"; scenarios, too:
    "vstatics[plot,simulation]".

    \b
    Exit status: 0 done; 1 a case is in error, a gear is tied up, or there is
    nothing to draw; 2 wrong use.
    """
    asked = DrawnColumns(x, y, z, by)
    of_sweeps = kind in SWEEP_PICTURES
    own = {"merge": merge, "wheels": wheels, "orders": tuple(orders or ()), "at": at}
    own["speed"] = speed
    refuse(
        *((True, f"--{name}: {why}") for name, why in misplaced(kind, own)),
        (order != "free" and kind != "stick", "--order: only stick diagrams have sets in a row"),
        (ratios and kind != "plan", "--ratios: only a plan follows from ratios alone"),
        (out and kind != "shift", "--out: only shift has columns of a run"),
        (gears and kind in _WITHOUT_GEARS, f"--gear: {_WITHOUT_GEARS.get(kind)}"),
        (cases and ratios is not None, "--ratios: without a case"),
        (not cases and ratios is None, "Missing argument 'CASE...'."),
        (
            not of_sweeps and asked != DrawnColumns(),
            "--x, --y, --z, --by: only map, curves and histogram are of columns",
        ),
        (kind == "histogram" and (x or z), "--x, --z: histograms are of the columns of --y"),
        (kind == "curves" and z, "--z: only a map has contours"),
        (
            (of_sweeps or kind == BOXES or ratios is not None)
            and settings[:3] != CaseOptions()[:3],
            "--from, --coast, --idle: they are of a case",
        ),
        (
            kind in ("traction", "sawtooth") and settings.coast is not None,
            "--coast: a vehicle is drawn at full load",
        ),
    )
    if output != STDOUT and not suffix_of(output) and len(cases) <= 1:
        _refuse_without_suffix(output)
    to = formats.each_by_itself(output, cases, FORMATS, "a picture", most=2)
    height = math.inf if is_stream(to.output) else PAGE_HEIGHT
    style = Style(lang, dark, wheels=wheels, merged=merge, width=width, height=height)
    style = style._replace(ordered=order == "as-given")
    if ratios is not None:
        return _plot_ratios(ratios, gears, to, style)
    if kind == BOXES:
        return plot_boxes(cases, to, cast("Format", to.form), style)
    if of_sweeps:
        return _plot_sweep(cases, kind, to, cast("Format", to.form), style, asked)
    options = settings._replace(
        scenarios=True, of_runs=kind in OF_RUNS, of_vibration=kind in OF_VIBRATION
    )
    style = style._replace(excited=Excitation(tuple(orders or ()), at, shown=speed))
    if len(cases) > 1 and not to.is_folder:
        return _plot_two(calculate(cases, options), kind, to, gears, out, style)
    picture = partial(_shown, kind=kind, form=to.form, gears=gears, out=out, style=style)
    return carry_out(Job("plot", options, to, picture), cases)


def _plot_sweep(
    sweeps: Sequence[str],
    kind: str,
    to: formats.Destination,
    form: Format,
    style: Style,
    asked: DrawnColumns,
) -> int:
    """Write the picture of a written sweep, in place of a case; the exit status.

    Raises
    ------
    UsageError
        If there are several files.
    ReadError
        If the file is no sweep, there is nothing to draw, or the picture can't be written.
    """
    from vstatics.core.readers import sweep_tables
    from vstatics.sweep.pictures import render_sweep

    if len(sweeps) > 1 or to.is_folder:
        raise click.UsageError(f"{kind}: expected one written sweep, and a file for its picture")
    data, name = files.read_input(sweeps[0], TABLE_BYTES)
    if not is_a("sweep", data, name):
        message = "this is no table of variants: expected what `vstatics sweep -o` has written"
        raise ReadError([of_file("E039", name, message)])
    sweep = sweep_tables.read(data, name)
    with files.problems_of_file(name):
        drawn = render_sweep(sweep, kind, form, style, asked)
    files.write_pages(drawn, to.output)
    return DONE


def _plot_ratios(
    ratios: list[float], gears: tuple[str, ...], to: formats.Destination, style: Style
) -> int:
    """Draw the plan of ratios alone."""
    from vstatics.pictures.plan.wanted import case_of_ratios

    with wrong_value("--ratios"):
        case = case_of_ratios(ratios, style)
    chosen = [arguments.gear_number(case, gear) for gear in dict.fromkeys(gears)]
    drawn = pages(solve(case), "plan", cast("Format", to.form), style, chosen)
    files.write_pages(drawn, to.output)
    return DONE


def _excited(outcome: CalculatedCase, results: Results, style: Style) -> Style:
    """A style with the speeds that a scenario tells.

    Raises
    ------
    BadParameter
        If there is no such link.
    """
    excited = style.excited
    if excited.at:
        with wrong_value("--at"):
            results.case.link_number(excited.at)
    if outcome.scenario is not None:
        excited = excited._replace(speeds=outcome.scenario.input_speeds)
    return style._replace(excited=excited)


def _plot_two(
    outcomes: Iterable[CalculatedCase],
    kind: str,
    to: formats.Destination,
    gears: tuple[str, ...],
    out: str,
    style: Style,
) -> int:
    """Draw two cases on one sheet; the exit status."""
    from vstatics.pictures.pair import PairedCase, pair_pages

    both, failed = [], False
    for outcome in outcomes:
        failed |= outcome.failed
        if outcome.results is not None:
            case = outcome.results.case
            style = _excited(outcome, outcome.results, style)
            chosen = [arguments.gear_number(case, gear) for gear in dict.fromkeys(gears)]
            motion = run_of(outcome, out) if kind in OF_RUNS else None
            results = outcome.results if motion is None else named_by_run(outcome.results, outcome)
            name = os.path.basename(outcome.file)  # noqa: PTH119
            both.append(PairedCase(name, results, chosen, motion))
    if len(both) == 2:
        drawn = pair_pages(both, kind, cast("Format", to.form), style)
        files.write_pages(drawn, to.output)
    return FAILED if failed else DONE


def _refuse_without_suffix(output: str) -> None:
    if not (is_stream(output) or output.endswith("/") or os.path.isdir(output)):  # noqa: PTH112
        expected = " ".join(known(FORMATS))
        raise click.UsageError(
            f"can't tell the format of {output}: expected a suffix of {expected}"
        )


def _shown(
    outcome: CalculatedCase,
    results: Results,
    kind: str,
    form: str,
    gears: tuple[str, ...],
    out: str,
    style: Style,
) -> texts.CaseOutput:
    """A picture of a case."""
    chosen = [arguments.gear_number(results.case, gear) for gear in dict.fromkeys(gears)]
    motion = run_of(outcome, out) if kind in OF_RUNS else None
    results = results if motion is None else named_by_run(results, outcome)
    if kind in OF_ORDERS:
        style = _excited(outcome, results, style)
    try:
        drawn = pages(results, kind, cast("Format", form), style, chosen, motion=motion)
    except CaseError as error:
        raise ReadError(one.in_file(outcome.file) for one in error.problems) from None
    return texts.CaseOutput([], {form: lambda _: drawn})
