"""`vstatics sweep`: variants of a case or of a scenario, written as a table.

`command` declares the options and builds a plan. `subject` reads the case or scenario. `estimate`
predicts the number of variants, the size of the table and the time. `run` executes the plan, writes
a file or a stream, and reports the outcome, also for samples of ``vstatics simulate``.
"""
