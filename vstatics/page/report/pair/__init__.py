"""Two cases on one page: each number of both, what differs by what is other in the cases.

`merged` puts their tables together, `runs` has the runs of scenarios, `page` the sections. Cases
are called A and B: `label` of `PagedCase`, ``data-case`` of a number.
"""
