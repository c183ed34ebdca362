"""Two cases on one page, with corresponding numbers below each other, and with the changes.

`merged` merges two tables into one, `paged` has the contents of each case, and `page` the sections.
The cases are labelled A and B, in `PagedCase.label` and in the attribute ``data-case`` of numbers.
"""
