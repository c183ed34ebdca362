"""Sweeps: thousands or millions of variants of a case, each with selected results.

>>> from vstatics import Gear, Mechanism, Transmission
>>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear(speeds={2: 0})])
>>> for chunk in sweep(case, {"D1.ratio": "-4:-2:5"}, out="ratio[1]", where="ratio[1] > 4"):
...     print(chunk.values[:, 0], chunk.columns[:, 0])
[-4.  -3.5] [5.  4.5]

`build` turns `options` into a `plan`: numbered `variants`, with expressions of their `results` as
columns and conditions. Worker processes calculate pieces of the plan (`chunk`, `tasks`). `output`
assembles the pieces to a file in one of the `formats`, `swept` returns them in Python. `pictures`
draws sweep files, and `cli` is the command `vstatics sweep`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Literal

from vstatics.core.arguments import naming, refusing, type_and_value

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from vstatics.core.model.transmission import IdleConvention
    from vstatics.sweep.results.documents import Subject
    from vstatics.sweep.swept import Sweep

__all__ = ["sweep"]


@refusing(
    Subject="vstatics.sweep.results.documents", IdleConvention="vstatics.core.model.transmission"
)
@naming
def sweep(  # noqa: PLR0913 (as on the command line)
    case: Subject,
    vary: Mapping[str, ArrayLike | str] | Sequence[str] | str = (),
    *,
    zip: bool = False,  # noqa: A002
    sample: int | None = None,
    method: Literal["sobol", "lhs", "random"] = "sobol",
    seed: int = 0,
    variants: Mapping[str, ArrayLike] | None = None,
    linked: Mapping[str, str] | Sequence[str] = (),
    out: str | Sequence[str] = "ratio,efficiency",
    where: str | None = None,
    min: str | Sequence[str] = (),  # noqa: A002
    max: str | Sequence[str] = (),  # noqa: A002
    best: int | None = None,
    by: Literal["gear"] | None = None,
    coast: bool | None = None,
    idle: IdleConvention | None = None,
    jobs: int = 1,
) -> Sweep:
    """Calculate variants of a case, a chunk at a time.

    Parameters
    ----------
    case : Transmission or VariedScenario
        Case or scenario to vary; `vstatics.load_varied` reads a scenario.
    vary : mapping of str to array_like or str, sequence of str, or str
        Varied numbers: ``{"D1.ratio": [-0.9, -0.8]}``, ``{"D1.ratio": "-0.9:-0.7:201"}`` or
        ``["D1.ratio=-0.9:-0.7:201"]``. The variants are a grid of all combinations, in which the
        last number runs fastest. Numbers of elastic parts and inertias are ``"shaft.stiffness"``
        [N*m/rad], ``"shaft.compliance"`` [rad/(N*m)], ``"shaft.damping"`` [N*m*s/rad],
        ``"engine.inertia"`` [kg*m^2]. Arrays of speeds, torques and powers are in rad/s, N*m and W,
        even in a scenario and although `Load` has rpm; ``"load.speed [rpm]"`` is in rpm.
    zip : bool
        Take the first values of all numbers together, then the second values, and so on, instead of
        a grid.
    sample : int, optional
        Number of variants drawn between ``low:high`` of each number, instead of a grid.
    method : {"sobol", "lhs", "random"}
        Sampling method (of scipy).
    seed : int
        Seed of the sample; equal seeds give equal samples.
    variants : mapping of str to array_like, optional
        A table of variants instead of `vary`: for each number, its values in all variants. [-]
    linked : mapping of str to str, or sequence of str
        Formulas of numbers that follow from varied numbers, earlier linked numbers, and numbers of
        the case: ``{"P1.teeth.planet": "(P1.teeth.ring - P1.teeth.sun)/2"}``.
    out : str or sequence of str
        Columns of the result, as in ``--out`` of the command line.
    where : str, optional
        Condition that a variant must satisfy to get a row.
    min, max : str or sequence of str
        Objectives to minimise and maximise. Only the best variants get a row, all in one chunk.
    best : int, optional
        Number of best variants; 20 by default for a single objective.
    by : {"gear"}, optional
        One row for each gear of a variant; `Chunk.of_gear` has the gear of each row.
    coast, idle : optional
        As in `vstatics.solve`.
    jobs : int
        Number of processes. Several processes import the script again, so its statements must be
        protected by ``if __name__ == "__main__":``.

    Returns
    -------
    Sweep
        An iterator of chunks in order of the variants; `Chunk.columns` has the shape (rows,
        columns). Its `to_dataframe` and `to_xarray` have all variants at once.

    Raises
    ------
    ReadError
        If a text is invalid, with the place of the error.
    CaseError
        If the sweep is impossible, or a package is missing.
    TypeError
        If `vary` is a table, such as one of pandas.
    ValueError
        If arguments exclude one another.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission
    >>> case = Transmission(3, [ShiftElement(1, 2), ShiftElement(2, 0)],
    ...                     [Mechanism(1, 2, 3, -2.5, 0.96)], [Gear([1]), Gear([2])])
    >>> chunk, = sweep(case, {"D1.ratio": [-2, -2.5, -3]}, out="ratio", where="ratio[2] > 3.2")
    >>> chunk.headings, chunk.variants
    (('ratio[1]', 'ratio[2]'), array([1, 2]))
    >>> chunk.columns
    array([[1. , 3.5],
           [1. , 4. ]])
    """
    from vstatics.core.extras import require
    from vstatics.sweep import build
    from vstatics.sweep.options import SweepOptions, conflicts
    from vstatics.sweep.swept import Sweep

    for name, count in (("jobs", jobs), ("best", best)):
        if count is not None and count < 1:
            raise ValueError(f"{name} is {count}, expected 1 or more")
    if not isinstance(vary, str | Mapping):
        vary, given = [*vary], vary
        if hasattr(given, "keys") or not all(isinstance(text, str) for text in vary):
            expected = "expected a mapping or texts; a table of variants is `variants`"
            raise TypeError(f"sweep: `vary` is {type_and_value(given)}, {expected}")
    options_given: dict[str, object] = {
        "variants": variants is not None,
        "vary": bool(vary),
        "zip": zip,
        "sample": sample,
    }
    options_given |= {"min": min, "max": max, "best": best}
    for message in conflicts(options_given):
        raise ValueError(message)
    if sample is not None and method != "random":
        require("sample", f"the method {method}")
    arrays = dict(vary) if isinstance(vary, Mapping) else {}
    texts = () if isinstance(vary, Mapping) else (vary,) if isinstance(vary, str) else vary
    links = linked
    if isinstance(linked, Mapping):
        links = [f"{name}={formula}" for name, formula in linked.items()]
    options = SweepOptions.of(
        vary=texts,
        linked=(links,) if isinstance(links, str) else links,
        zip=zip,
        sample=sample,
        method=method,
        seed=seed,
        out=out,
        where=where,
        min=(min,) if isinstance(min, str) else min,
        max=(max,) if isinstance(max, str) else max,
        best=best,
        by=by,
        coast=coast,
        idle=idle,
    )
    return Sweep(build.plan(case, options, arrays=arrays, table=variants), jobs)
