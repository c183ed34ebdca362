"""Comparison of written results: changes of the case, and numbers that differ.

`numbers` compares the tables of two results, after `namesakes` has matched renamed rows. `steps`
compares step ratios, and `case_changes` compares the input data of the cases. `verdicts` combines
all differences into a verdict on one case or on many, `layout` formats the verdicts, and
`compared_files` finds the results to be compared. `sweeps` compares sweeps.

>>> from vstatics import Gear, Mechanism, Transmission
>>> from vstatics.core.comparison.case_changes import case_changes
>>> old, new = (Transmission(2, [], [Mechanism(1, 2, 0, u)], [Gear()]) for u in (-2.5, -3.0))
>>> list(case_changes(new, old))
[CaseChange(path='D1.ratio', expected=-2.5, actual=-3.0)]
"""
