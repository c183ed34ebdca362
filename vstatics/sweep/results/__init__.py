"""Results of variants: columns, conditions, selection of the best, statistics.

`expressions` reads an expression of results. `names` finds the meaning (`meanings`) of each name in
it for a case; scenarios have their own finder (`documents`). `columns` reads the list of columns.
`selection` reads conditions and objectives, `best` finds the best variants, and `statistics`
summarises many variants.
"""
