"""`vstatics sweep`: variants of a case or of a scenario, written as a table.

`command` has the options and builds a plan. `subject` reads a case or a document of an annex.
`estimate` predicts the number of variants, the size of the table and the time. `run` carries the
plan out, to a file or a stream, and reports the outcome, also for samples of
``vstatics simulate``.
"""
