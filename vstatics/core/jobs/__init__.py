"""Long work on many items, in several processes, with finished work that can be resumed.

Each worker receives a state once. It then calls `function(state, item)` for each item. A worker
process that dies is replaced. If a run is stopped, a later run can reuse its finished work.

>>> from vstatics.core.jobs.workers import workers
>>> with workers(10, describe=str, jobs=1) as called:
...     [power for item, power in called.each(pow, [1, 2, 3], ordered=True)]
[10, 100, 1000]

Workers: `workers` (choice), `alone`, `processes`, `cluster`. Files of finished work:
`finished_cases`, `finished_parts`, `finished_pieces`, `piece_file`, `lock`, `state_files`, `files`,
`page_files`, `spool`. Input: `input_files`. Signals: `stopping`.
"""
