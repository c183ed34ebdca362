"""Gears of a case: the effect of each combination of engaged shift elements.

`speed_forms` expresses all speeds of a case by as few free speeds as its equations permit. `kinds`
determines the effect of a combination on input and output, and its torques; `ports` changes the
input and output of a case. `search` chooses the shift elements and examines all combinations.
`found_gears` converts combinations to gears of a case, and `case_of_scheme` a scheme to a case,
with `names` for its gears and gear sets.
"""
