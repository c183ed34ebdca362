"""Two written results of one case: what changed in the case, and which numbers differ by that.

`numbers` holds tables against tables, whose rows `namesakes` finds under other names; `steps`
makes steps of their ratios, `case_changes` tells what is other in the case by its paths.
`verdicts` puts these together for one case or many, `layout` lays them out. Sweeps are held
against sweeps in `sweeps`.

>>> from vstatics import Gear, Mechanism, Transmission
>>> from vstatics.core.comparison.case_changes import case_changes
>>> one, other = (Transmission(2, [], [Mechanism(1, 2, 0, u)], [Gear()]) for u in (-2.5, -3.0))
>>> list(case_changes(other, one))
[CaseChange(path='D1.ratio', expected=-2.5, actual=-3.0)]
"""
