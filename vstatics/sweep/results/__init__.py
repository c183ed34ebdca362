"""Results of variants: columns, conditions, the best variants, statistics.

`expressions` reads the expression of a column. `names` finds the meanings of its names (`meanings`)
for a case; other documents supply their own finder (`documents`). `columns` reads a list of
expressions. `selection` decides which variants are written, `best` sorts them, and `statistics`
summarises many variants.
"""
