"""What is kept of variants: columns, conditions, the best, statistics.

`expressions` makes a column of a text: `names` and `motion_names` know what its names mean
(`meanings`); `columns` reads a list of them, `asked` one of columns of a run. `selection` says
which variants are kept, `best` puts these in order, `statistics` has what many have in common.
"""
