"""Results of variants: columns, conditions, the best variants, statistics.

`expressions` calculates a column from a text: `names` finds the meanings of names (`meanings`) for
a case, and a document finds them itself (`documents`); `columns` reads a list of expressions.
`selection` decides which variants are written, `best` sorts them, and `statistics` summarises
many variants.
"""
