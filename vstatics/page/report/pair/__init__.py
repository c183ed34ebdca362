"""Two cases on a page, with corresponding numbers below each other and their changes.

`merged` merges two tables into one, `paged` holds the contents of each case, and `page` the
sections. The cases are called A and B: in `PagedCase.label`, and in the attribute ``data-case`` of
numbers.
"""
