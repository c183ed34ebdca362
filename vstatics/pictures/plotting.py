"""Pictures for Python: shown in a notebook, or saved to a file."""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from typing import TYPE_CHECKING

from vstatics.core.annexes import module_of_name
from vstatics.core.arguments import refusing
from vstatics.core.extras import higher, require
from vstatics.core.jobs.page_files import replace_pages
from vstatics.core.statics.results import Results, expect_one_case
from vstatics.core.suggestions import nearest
from vstatics.core.tables.file_suffixes import format_of, known
from vstatics.core.texts import Language
from vstatics.pictures import drawn_kinds, misplaced, pages, picture, render
from vstatics.pictures.drawing.files import FORMATS, Format
from vstatics.pictures.drawing.lengths import checked_width
from vstatics.pictures.drawing.style import (
    PAGE_HEIGHT,
    PAGE_WIDTH,
    POINTS_PER_MILLIMETRE,
    Excitation,
    PictureFiles,
    Style,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from vstatics.pictures.runs import PicturedRun as Motion


class Picture:
    """Picture of the results of a case, which a notebook shows as SVG."""

    def __init__(
        self,
        results: Results,
        kind: str,
        style: Style,
        gears: Sequence[int],
        motion: Motion | None = None,
    ) -> None:
        """Store the arguments; showing or saving draws the picture."""
        self._drawn = results, kind, style, gears
        self._motion = motion

    def __repr__(self) -> str:
        """Return the kind of picture and the results."""
        results, kind, _, _ = self._drawn
        return f"<Picture {kind} of {results!r}>"

    def _repr_svg_(self) -> str:
        results, kind, style, gears = self._drawn
        return render(results, kind, "svg", style, gears, motion=self._motion).decode()

    @property
    def figure(self) -> Figure:
        """Picture as a matplotlib figure, which can be changed."""
        return picture(*self._drawn, motion=self._motion)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the picture to a file: SVG, PNG or PDF by the suffix.

        Each page after the first is a file of its own such as ``box-2.svg``, or a page of the PDF.

        Parameters
        ----------
        path : path-like
            File to write.

        Raises
        ------
        ValueError
            If the suffix is not known.
        ReadError
            If a further page would overwrite a file that is not a picture of this name.
        """
        form = format_of_picture(path)
        results, kind, style, gears = self._drawn
        style = style._replace(height=PAGE_HEIGHT)
        drawn = pages(results, kind, form, style, gears, motion=self._motion)
        replace_pages(os.fspath(path), drawn)


def format_of_picture(path: str | os.PathLike[str]) -> Format:
    """Return the format of a picture from the suffix of the file name.

    Raises
    ------
    ValueError
        If the suffix is not known.

    Examples
    --------
    >>> format_of_picture("lever.PNG")
    'png'
    """
    form = format_of(os.fspath(path), FORMATS)
    if form is None:
        suffixes = ", ".join(known(FORMATS))
        raise ValueError(f"a picture as {os.fspath(path)}: expected a suffix of {suffixes}")
    return form


@refusing(Motion=module_of_name("Motion"))
def plot(  # noqa: PLR0913 - all but the first argument are given by name
    results: Results,
    kind: str = "plan",
    *,
    gear: int | str | None = None,
    motion: Motion | None = None,
    wheels: bool = False,
    merge: bool = False,
    orders: Sequence[float] = (),
    speed: tuple[float, float] | None = None,
    at: int | str = "",
    duty: str | os.PathLike[str] = "",
    classes: int | Sequence[float] | None = None,
    torque: str | os.PathLike[str] = "",
    width: float = PAGE_WIDTH / POINTS_PER_MILLIMETRE,
    dark: bool = False,
    lang: Language = "en",
) -> Picture:
    """Draw a picture of the results of a case.

    Parameters
    ----------
    results : Results
        Results of one case.
    kind : str
        Kind of picture, as in ``vstatics plot --kind``: plan, lever, flow, structure, stick,
        efficiency, modes, campbell, response, dump, shift, traction, sawtooth, steps, spectrum.
    gear : int or str, optional
        Number from 1, or name, of the gear to show; by default all gears.
    motion : Motion, optional
        Simulated run of the case, for the kinds `shift` and `plan`.
    wheels : bool, optional
        Whether stick diagrams show names and tooth numbers of gears.
    merge : bool, optional
        Whether two gear sets with two common links become one lever.
    orders : sequence of float, optional
        Orders of the speed, for the kinds `campbell` and `response`; by default the orders of the
        engine.
    speed : tuple of float, optional
        Range of speeds for the kinds `campbell` and `response`; by default the range of the
        case. [rpm]
    at : int or str, optional
        Number or name of the link of a `response`; by default the input.
    duty : path-like, optional
        CSV file of the duty cycle of a `spectrum`.
    classes : int or sequence of float, optional
        Number of classes of torque of a `spectrum`, by default 10, or their upper bounds. [N*m]
    torque : path-like, optional
        CSV file of the orders of the torque of a `response`; by default 1 N*m for each order.
    width : float, optional
        Width of a page, 80 to 1200; the font size does not change. [mm]
    dark : bool, optional
        Whether to draw light lines on a dark ground.
    lang : {"en", "ru"}, optional
        Language of axes and titles.

    Returns
    -------
    Picture
        A notebook shows the picture as SVG; ``save`` writes a file, ``figure`` is a matplotlib
        figure.

    Raises
    ------
    CaseError
        If matplotlib is not installed, or the case has nothing to draw.
    ValueError
        If the kind, gear, link or language does not exist, the kind does not have an option, an
        order is not positive, the speeds are not a range, or the width is outside the limits.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> plot(solve(case), "lever")._repr_svg_()[:5]
    '<?xml'
    """
    expect_one_case(results, "plot")
    require("plot", "a picture")
    if kind not in (kinds := drawn_kinds()):
        hint = nearest(kind, kinds) or f"; expected one of {', '.join(kinds)}"
        raise ValueError(f"there is no picture {kind!r}{hint}")
    drawn_files = PictureFiles(
        os.fspath(duty), PictureFiles().classes if classes is None else classes, os.fspath(torque)
    )
    files = {"duty": drawn_files.duty, "classes": classes, "torque": drawn_files.torque}
    given = {"motion": motion, "merge": merge, "wheels": wheels, "at": at, "gear": gear}
    for name, why in misplaced(kind, {**given, **files, "orders": tuple(orders), "speed": speed}):
        raise ValueError(f"plot of kind {kind!r}: `{name}` is not for it, {why}")
    if kinds[kind].shows == "run" and motion is None:
        hint = "motion=vstatics.simulate(scenario), whose `plot` draws it, too"
        raise ValueError(f"plot of kind {kind!r} shows a run: expected {hint}")
    gears = () if gear is None else (results.case.gear_number(gear),)
    if not all(0 < order < math.inf for order in orders):
        raise ValueError(f"read orders {[*orders]}, expected numbers above 0")
    if speed is not None and not 0 <= speed[0] < speed[1] < math.inf:
        raise ValueError(f"read speed {speed}, expected a speed from 0 on, and a higher speed")
    link = str(results.case.link_number(at)) if at else ""
    excited = Excitation(tuple(map(float, orders)), link, shown=speed)
    style = Style(
        lang, dark, wheels=wheels, merged=merge, width=checked_width(width), excited=excited
    )
    if kinds[kind].reads:
        style = style._replace(data=higher(kinds[kind].reads)(drawn_files))
    return Picture(results, kind, style, gears, motion)
