"""What is kept of variants: columns, conditions, the best, statistics.

`expressions` makes a column of a text: `names` knows what its names mean (`meanings`) for a case,
a document knows it itself (`documents`); `columns` reads a list of them. `selection` says which
variants are kept, `best` puts these in order, `statistics` has what many have in common.
"""
