"""Two cases on one page: their numbers one above the other, and the changes between them.

`merged` merges two tables into one, `paged` has the contents of each case, and `page` the sections.
The cases are labelled A and B, in `PagedCase.label` and in the attribute ``data-case`` of numbers.
"""
