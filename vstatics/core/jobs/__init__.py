"""Work on many items, whatever they are: processes, finished work, whole files.

A state goes to every worker once, then `function(state, item)` is done for each item. A
worker that dies is replaced; what was finished before a run was stopped is trusted later.

>>> from vstatics.core.jobs.workers import workers
>>> with workers(10, describe=str, jobs=1) as called:
...     [power for item, power in called.each(pow, [1, 2, 3], ordered=True)]
[10, 100, 1000]

Who does it: `workers` (choice), `alone`, `processes`, `cluster`. What lasts:
`finished_cases`, `finished_parts`, `finished_pieces`, `piece_file`, `lock`, `state_files`, `files`,
`page_files`, `spool`. What it reads: `input_files`. How it ends: `stopping`.
"""
