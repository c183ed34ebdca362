"""Integer tooth numbers for wanted ratios of gears or gear sets.

`problem` checks the request, `layout` describes the gear sets of a case with unknown tooth numbers,
and `limits` their ranges. `rows` lists all tooth numbers of a gear set that satisfy the
`conditions`, and `table` sorts them by their ratios. `targets` calculates deviations from the
wanted ratios, `search` finds the best tooth numbers of all gear sets together, and `solutions`
contains the results and the case with them. `finding` combines all steps, `tables` presents the
results.
"""
