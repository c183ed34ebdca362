"""Several axes on paper.

`links` has links and ports, `marks` the signs of shift elements and springs, `wheels` the wheels
and sets.
"""
