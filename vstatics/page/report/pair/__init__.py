"""Two cases on one page, with corresponding numbers below each other and their changes.

`merged` merges two tables into one, `paged` contains the contents of each case, and `page` the
sections. The cases are called A and B: in `PagedCase.label`, and in the attribute ``data-case`` of
numbers.
"""
