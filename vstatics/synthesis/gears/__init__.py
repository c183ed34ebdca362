"""Gears of a scheme: the effect of each combination of its shift elements.

`speed_forms` expresses all speeds of a case by as few free speeds as its equations leave. `kinds`
determines the effect of a set of engaged elements on input and output, and the torques; `ports`
changes the input and output of a case. `search` chooses the elements and examines all combinations.
`found_gears` converts the results to gears of a case, `case_of_scheme` a scheme to a case; `names`
has the names of its gears and gear sets.
"""
