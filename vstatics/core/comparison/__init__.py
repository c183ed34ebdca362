"""Comparison of results in files: changes of the case, and numbers that differ.

`numbers` compares the tables of two results, after `namesakes` has matched renamed rows. `steps`
compares step ratios, `case_changes` the input data of cases, and `sweeps` compares sweeps.
`verdicts` combines all differences of a case, or of many cases, in a verdict, and `layout` formats
the verdicts. `compared_files` pairs the results in files and directories.

>>> from vstatics import Gear, Mechanism, Transmission
>>> from vstatics.core.comparison.case_changes import case_changes
>>> old, new = (Transmission(2, [], [Mechanism(1, 2, 0, u)], [Gear()]) for u in (-2.5, -3.0))
>>> list(case_changes(new, old))
[CaseChange(path='D1.ratio', expected=-2.5, actual=-3.0)]
"""
