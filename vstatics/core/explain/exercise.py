"""A gear as an exercise, for those who work in Python."""

from __future__ import annotations

from vstatics.core.arguments import refusing
from vstatics.core.explain.drawn_numbers import drawn, unchanged
from vstatics.core.explain.worksheet import GearExercise, worksheet
from vstatics.core.statics.results import Results, expect_one_case


@refusing()
def exercise(results: Results, gear: int | str, *, seed: int | None = None) -> GearExercise:
    """A gear whose numbers are asked for: with blanks, and with its solution.

    Parameters
    ----------
    results : Results
        Of one case.
    gear : int or str
        Its number from 1, or its name.
    seed : int, optional
        With other teeth, which can be assembled, ratios, and capacities of the same margins; the
        same of the same number, which is 0 or more.

    Returns
    -------
    GearExercise
        `blanks` with their numbers as in the JSON of a result; `worksheet` and `solution` write
        it as text, Markdown or LaTeX; `document` is the solution as plain data.

    Raises
    ------
    ValueError
        If there is no such gear, the seed is below 0, or the results are of arrays of variants.
    CaseError
        If the gear has no numbers.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> made = exercise(solve(case), "1")
    >>> "[2] ____" in made.worksheet(), "[2] .286" in made.solution()
    (True, True)
    """
    expect_one_case(results, "exercise")
    index = results.case.gear_number(gear) - 1
    if seed is not None:
        if seed < 0:
            raise ValueError(f"seed is {seed}, expected 0 or more")
        given, results = results.case, drawn(results, seed)
        return worksheet(results, index, seed, unchanged(given, results.case))
    return worksheet(results, index)
