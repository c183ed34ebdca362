"""The gears of a scheme: what combinations of its shift elements give.

`speed_forms` has all speeds of a case in as few free ones as its equations leave, `kinds` tells
what a set of engaged elements does with input and output, and its torques; `ports` gives the case
other ones. `search` chooses the elements, and goes
through all combinations of them. `found_gears` makes gears of a case of what is found,
`case_of_scheme` a whole case of a scheme; `names` has the names of its gears and sets.
"""
