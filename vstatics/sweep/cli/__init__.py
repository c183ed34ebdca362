"""`vstatics sweep`: variants of a case or of a scenario, to a table.

`command` has the options and makes a plan of them. `subject` reads what is varied: a case, or a
document of an annex. `estimate` tells before anything is calculated how many variants there
are, how large the table becomes and how long it takes. `run` carries the plan out, to a file or a
stream, and says what became of it; samples of ``vstatics simulate`` are carried out by it, too.
"""
